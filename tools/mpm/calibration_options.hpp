#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/problem.hpp"
#include "options.hpp"

namespace granulaw {

/// Options of `mpm calibrate` and `mpm design`: data, known and wanted numbers of the specimen.
struct CalibrationOptions
{
  std::vector<std::string> data, fit, priors, bounds, known;
  std::optional<double> radius, density, youngs_modulus, yield_stress, hardening_modulus, offset, indenter_radius;
  double poisson_ratio = 0.3, relative_sd = 0.01;
  std::string kind = "platens", partner = "wall", name = "material", hardening = "linear";
  std::string materials;             ///< a file that holds the materials of wall, indenter and ball
  std::string wall, indenter, ball;  ///< names there; empty: rigid, and the ball is what is fitted
  std::string leeb;  ///< impact device of a rebound tester
  ImpactBody body;
  bool compliance = false, plain = false;

  void add_to(Options& command, bool needs_data);
  /// The request, its files read and its words understood. Throws Error.
  CalibrationRequest request() const;
  /// A measurement of this kind without data: radii, partner, machine. `device_has_radius`: --radius may be left out.
  Measurement form(const Kind& kind, const std::string& source, bool device_has_radius = false) const;
  /// The kind that --kind chooses of those whose columns are alike.
  const Kind& curves() const;

 private:
  Measurement measurement(const std::string& path) const;
  void set_hardening(CalibrationRequest& request) const;
  void set_ranges(CalibrationRequest& request) const;
  void check_plausible_numbers(const CalibrationRequest& request) const;
};

/// "NAME = A..B" of a prior or a bound; NAME may hold a '/'. `option` leads the sentence of what cannot be
/// understood.
struct NamedRange
{
  std::string name;
  Range range;
};
NamedRange parse_named_range(const std::string& word, const std::string& option);
/// "A..B", both over 0, A below B. `form`: what is allowed, for the sentence.
Range parse_range(const std::string& word, const std::string& option, const std::string& form = "'LOW..HIGH', SI, both over 0");

}  // namespace granulaw
