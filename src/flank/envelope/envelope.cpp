#include "flank/envelope.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flank/base/assert.h"
#include "flank/base/parallel.h"

namespace flank {
using namespace internal;
namespace {

/// A unit vector across u if the motion gives none.
Vec3 any_across(const Vec3& u) { return u.unitOrthogonal(); }

/// Place i of `count` over [0, 1], ends included; a single one is in the middle.
double share(int i, int count) { return count > 1 ? static_cast<double>(i) / (count - 1) : 0.5; }

}  // namespace

ContactPoint contact_point(const AxisJet& axis, const RadialJet& radial, double s, int side) {
  FLANK_ASSERT(side == 1 || side == -1);
  const Vec3 v = axis.velocity(s);
  const double v_par = v.dot(axis.u);
  const Vec3 v_perp = v - v_par * axis.u;
  const double speed = v_perp.norm();
  // Cosine of the meridian's slope; 0 for a radial function that is no tool.
  const double q = std::sqrt(std::max(0.0, 1.0 - radial.d1 * radial.d1));
  const double numerator = radial.d1 * v_par, denominator = q * speed;
  ContactPoint contact;
  if (numerator != 0.0) contact.c = numerator / denominator;  // infinite if the axis point moves along u
  contact.exists = std::abs(contact.c) < 1.0 && denominator > 0.0;
  const double c = std::clamp(contact.c, -1.0, 1.0);
  const Vec3 e1 = speed > 0.0 ? Vec3(v_perp / speed) : any_across(axis.u);
  const Vec3 e2 = axis.u.cross(e1);
  // (1 - c)(1 + c) keeps digits that 1 - c^2 loses near the limit.
  contact.normal = -radial.d1 * axis.u + q * (c * e1 + side * std::sqrt((1.0 - c) * (1.0 + c)) * e2);
  contact.point = axis.at(s) + radial.r * contact.normal;
  return contact;
}

ContactPoint contact_point(const RuledMotion& motion, const RadialFunction& radial, double s, double t, int side) {
  return contact_point(motion.jet(t), radial.at(s), s, side);
}

int contact_side(const RuledMotion& motion, const RadialFunction& radial, const Vec3& towards) {
  const double s = 0.5 * radial.axis_length();
  const double plus = contact_point(motion, radial, s, 0.5, +1).normal.dot(towards);
  const double minus = contact_point(motion, radial, s, 0.5, -1).normal.dot(towards);
  return plus >= minus ? +1 : -1;
}

std::vector<ContactPoint> characteristic(const RuledMotion& motion, const RadialFunction& radial, double t, int side,
                                         int count_s) {
  FLANK_ASSERT(count_s >= 2);
  const AxisJet axis = motion.jet(t);
  std::vector<ContactPoint> contacts;
  contacts.reserve(static_cast<std::size_t>(count_s));
  for (int j = 0; j < count_s; ++j) {
    const double s = radial.axis_length() * share(j, count_s);
    contacts.push_back(contact_point(axis, radial.at(s), s, side));
  }
  return contacts;
}

Regularity regularity(const RuledMotion& motion, const RadialFunction& radial, int count_t, int count_s) {
  FLANK_ASSERT(count_t >= 1 && count_s >= 1);
  Regularity worst;
  for (int i = 0; i < count_t; ++i) {
    const AxisJet axis = motion.jet(share(i, count_t));
    for (int j = 0; j < count_s; ++j) {
      const double s = radial.axis_length() * share(j, count_s);
      // c does not depend on the side.
      const ContactPoint contact = contact_point(axis, radial.at(s), s, +1);
      if (!contact.exists) ++worst.failures;
      // A pose at rest has no contact though c = 0 there (r' = 0): it is the worst there is.
      const double c = contact.exists ? std::abs(contact.c) : std::max(1.0, std::abs(contact.c));
      // Written so that a NaN counts as the worst, too.
      if (!(c <= worst.largest_c)) worst = {c, s, share(i, count_t), worst.failures};
    }
  }
  return worst;
}

std::vector<ContactPoint> sample_envelope(const RuledMotion& motion, const RadialFunction& radial, int side,
                                          int count_t, int count_s) {
  FLANK_ASSERT(count_t >= 1 && count_s >= 1);
  std::vector<ContactPoint> contacts(static_cast<std::size_t>(count_t) * static_cast<std::size_t>(count_s));
  std::vector<RadialJet> radii;
  radii.reserve(static_cast<std::size_t>(count_s));
  for (int j = 0; j < count_s; ++j) radii.push_back(radial.at(radial.axis_length() * share(j, count_s)));
  for (int i = 0; i < count_t; ++i) {
    const AxisJet axis = motion.jet(share(i, count_t));
    for (int j = 0; j < count_s; ++j)
      contacts[static_cast<std::size_t>(i * count_s + j)] =
          contact_point(axis, radii[static_cast<std::size_t>(j)], radial.axis_length() * share(j, count_s), side);
  }
  return contacts;
}

EnvelopeDeviation envelope_deviation(const RuledMotion& motion, const RadialFunction& radial, int side, int count_t,
                                     int count_s, const SignedDistance& distance) {
  FLANK_ASSERT(distance != nullptr);
  // Distances in parallel, sums in a fixed order after that: the same bits for any number of threads.
  constexpr std::size_t kGrain = 64;  // contacts per task; a footpoint costs microseconds
  const std::vector<ContactPoint> contacts = sample_envelope(motion, radial, side, count_t, count_s);
  std::vector<double> deviations(contacts.size(), std::numeric_limits<double>::quiet_NaN());
  parallel_blocks(contacts.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      if (contacts[k].exists) deviations[k] = distance(contacts[k].point);
  });
  EnvelopeDeviation out;
  double sum = 0.0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const double d = deviations[k];
    if (!contacts[k].exists) {
      ++out.missing;
      continue;
    }
    if (std::isnan(d)) {
      ++out.not_counted;
      continue;
    }
    const double t = share(static_cast<int>(k) / count_s, count_t);
    const double s = radial.axis_length() * share(static_cast<int>(k) % count_s, count_s);
    if (out.counted == 0 || d > out.largest_mm) {
      out.largest_mm = d;
      out.largest_s = s;
      out.largest_t = t;
    }
    if (out.counted == 0 || d < out.smallest_mm) {
      out.smallest_mm = d;
      out.smallest_s = s;
      out.smallest_t = t;
    }
    sum += d * d;
    ++out.counted;
  }
  if (out.counted > 0) out.rms_mm = std::sqrt(sum / out.counted);
  return out;
}

}  // namespace flank
