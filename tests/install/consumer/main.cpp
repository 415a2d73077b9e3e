#include <flank/part.h>
#include <flank/tool.h>

#include <iostream>

int main() {
  // One call into the lowest layers and one that needs the CAD kernel to link.
  const auto cylinder = flank::RadialFunction::spline(20.0, Eigen::VectorXd::Constant(4, 3.0));
  std::cout << "radius " << cylinder.at(10.0).r << '\n';
  try {
    return static_cast<int>(flank::read_part("no such file.step").faces.size());
  } catch (const std::exception&) {
    return 0;
  }
}
