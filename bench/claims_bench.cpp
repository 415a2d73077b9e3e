// usage: bench_claims [TEXT...]: measures the claims whose name contains one of the texts (all without any).
// FLANK_THREADS limits the threads (1 unless set: what the claims are stated for).
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "claims/claims.h"
#include "flank/threads.h"

namespace {

using namespace flank::internal::bench;

bool asked_for(const std::string& name, int argc, char** argv) {
  if (argc < 2) return true;
  for (int k = 1; k < argc; ++k)
    if (name.find(argv[k]) != std::string::npos) return true;
  return false;
}

void print(const Figure& figure, bool& all) {
  const char* relation = figure.kind == Figure::Kind::kAtMost ? "<=" : ">=";
  std::printf("  %-44s %12.5g", figure.what.c_str(), figure.value);
  if (figure.kind != Figure::Kind::kShown)
    std::printf("   %s %-10.4g %s", relation, figure.bound, figure.holds() ? "holds" : "MISSED");
  std::printf("\n");
  all = all && figure.holds();
}

}  // namespace

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const char* threads = std::getenv("FLANK_THREADS");
  flank::set_thread_count(threads ? std::atoi(threads) : 1);
  std::vector<Claim> claims;
  add_envelope_claims(claims);
  add_mesh_claims(claims);
  add_given_tool_claims(claims);
  add_part_claims(claims);
  add_avoidance_claims(claims);
  add_cover_claims(claims);
  add_judge_claims(claims);
  bool all = true;
  for (const Claim& claim : claims) {
    if (!asked_for(claim.name, argc, argv)) continue;
    std::printf("%s\n", claim.name.c_str());
    try {
      for (const Figure& figure : claim.run()) print(figure, all);
    } catch (const std::exception& e) {
      std::printf("  not measured: %s\n", e.what());
    }
  }
  return all ? 0 : 1;
}
