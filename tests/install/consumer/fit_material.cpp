// docs/reference/library.md: a yield stress from drops. fit_material ATLAS DROPS.csv
#include <cstdio>

#include "calibrate/calibrate.hpp"
#include "calibrate/measurement_file.hpp"
#include "characterise/atlas_file.hpp"

int main(int, char** argv)
{
  granulaw::CalibrationRequest request;
  request.known =
      granulaw::LawMaterial{.name = "grain", .density = 1540, .youngs_modulus = 3.2e9, .poisson_ratio = 0.25};
  request.fit = {granulaw::Parameter::yield_stress};
  granulaw::Measurement drops = granulaw::read_measurement(argv[2]);
  drops.radius = 1e-3;
  granulaw::complete_standard_deviations(drops, 0.01);
  request.measurements = {drops};
  const granulaw::Atlas atlas = granulaw::read_atlas(argv[1]);
  const granulaw::CalibrationProblem problem(atlas, request);
  const granulaw::Calibration found = granulaw::calibrate(problem);
  std::puts(granulaw::verdict(problem, found).c_str());
  const granulaw::Interval& within = found.parameters.front().profile.within95;
  return within.low < 41e6 && 41e6 < within.high ? 0 : 1;
}
