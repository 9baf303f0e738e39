#pragma once

#include "calibrate/calibrate.hpp"

namespace granulaw {

/// One further measurement that could be made.
struct DesignCandidate
{
  Measurement form;  ///< its kind, radii, partner; no data
  double place = 0;  ///< of the kind's column x, SI: a speed; the largest displacement of a curve
};

/// Expected half width of the 95 % interval of each wanted parameter, as a fraction of it (hardening: of H +
/// Y/2).
using ExpectedIntervals = std::vector<double>;

/// The candidates that would give most of a material, by the Fisher information at an assumed one: the fit's,
/// or a guess. Data that are there count, as do the model's own errors: no number of drops goes below these.
class Design
{
 public:
  /// `request`: the data that are there, and the wanted parameters; `assumed`: the material; `relative_sd`:
  /// of the candidates' values.
  Design(const Atlas& atlas, CalibrationRequest request, const CandidateMaterial& assumed,
         std::vector<DesignCandidate> candidates, double relative_sd);

  const std::vector<DesignCandidate>& candidates() const { return candidates_; }
  /// With these candidates, by index, besides what there is; none: what there is.
  ExpectedIntervals expected(const std::vector<std::size_t>& chosen) const;
  /// The `count` candidates that narrow the wanted parameters most, one after the other (the sum of the
  /// logarithms of their variances falls most), each in as many copies as that takes; in their order.
  std::vector<std::size_t> best(std::size_t count) const;

 private:
  Eigen::MatrixXd information(const std::vector<std::size_t>& chosen) const;
  double spread(const std::vector<std::size_t>& chosen) const;

  std::vector<DesignCandidate> candidates_;
  std::vector<double> shares_;  ///< of a wanted parameter's value that a unit of its coordinate is
  Eigen::MatrixXd there_;       ///< information of what there is
  std::vector<Eigen::MatrixXd> information_;  ///< by candidate
};

}  // namespace granulaw
