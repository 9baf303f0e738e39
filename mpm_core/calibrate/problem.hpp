#pragma once

#include <Eigen/Dense>
#include <memory>
#include <optional>

#include "calibrate/forward_model.hpp"
#include "calibrate/indenter_model.hpp"
#include "calibrate/parameters.hpp"
#include "calibrate/wall_model.hpp"

namespace granulaw {

/// What shall be found, and from what. SI.
struct CalibrationRequest
{
  std::vector<Measurement> measurements;  ///< with all standard deviations
  CandidateMaterial known;  ///< density and nu; of what is not fitted, its value; of what is, ignored
  std::vector<Parameter> fit;
  std::vector<ParameterRange> priors, bounds;
  std::optional<Range> hardness_ratio;  ///< prior of hardness over yield stress, in place of the model's
  bool robust = true;                   ///< outliers count in proportion to their distance, not to its square
};

/// The unknowns as a minimiser sees them, each of order one or a logarithm:
///     ln of a modulus or stress;  ln(1 + 2 H/Y_ref) of the hardening, which is linear where it is weak;
///     displacements of first touch and compliances over the curve's own scales;  the model's own errors over
///     their sd
using Coordinates = Eigen::VectorXd;

/// The sum of squares to be least: data, priors, the model's own errors, and walls at the ends of what is
/// allowed.
class CalibrationProblem
{
 public:
  /// Throws Error where the request cannot be met. `atlas` outlives this.
  CalibrationProblem(const Atlas& atlas, CalibrationRequest request);

  const CalibrationRequest& request() const { return request_; }
  SphereLawsCache& laws() const { return laws_; }
  /// What laws of other than linear hardening depart from flow_shape() by: of a law by runs.
  void set_departure(LawShape departure) { laws_.set_departure(std::move(departure)); }

  /// A place of the unknowns.
  struct Unknown
  {
    enum class Kind { modulus, hardening, offset, compliance, turn, model_error };
    Kind kind;
    Parameter parameter{};        ///< modulus, hardening
    std::size_t measurement = 0;  ///< the others
    double scale = 1, step = 1e-3;
    std::string name;
  };
  const std::vector<Unknown>& unknowns() const { return unknowns_; }
  std::size_t count() const { return unknowns_.size(); }
  std::size_t data_count() const { return data_; }
  /// Unknowns but for the model's own errors.
  std::size_t fitted_count() const;
  /// Index of a fitted parameter.
  std::size_t index_of(Parameter parameter) const;

  CandidateMaterial material(const Coordinates& q) const;
  MachineState machine(const Coordinates& q, std::size_t measurement) const;
  double value(std::size_t unknown, double q) const;  ///< SI
  double coordinate(std::size_t unknown, double value) const;
  /// Ends of what the atlas, the bounds and the data allow the unknown, all others at q, as coordinates.
  Range allowed(std::size_t unknown, const Coordinates& q) const;

  /// Residuals: (measured - predicted)/sd for each datum; priors; model errors; walls.
  Eigen::VectorXd residuals(const Coordinates& q) const;
  /// Those of one measurement without the model's own errors, and its prediction.
  struct Comparison
  {
    std::vector<double> predicted, with_errors, sd;
  };
  Comparison compare(const Coordinates& q, std::size_t measurement) const;
  /// How far data, priors and model errors scatter about the fit, as the loss counts them.
  struct Scatter
  {
    double chi_squared = 0;   ///< a robust fit counts an outlier as a value at its limit of three sd
    double share_within = 1;  ///< of the data: no outliers
  };
  Scatter scatter(const Coordinates& q) const;
  /// Sentence on the end of the method's range that the data push against; empty: none.
  std::string bound_met(const Coordinates& q) const;

  /// Places from which a search may begin, the most promising first.
  std::vector<Coordinates> starts() const;

 private:
  Prediction prediction(const Coordinates& q, std::size_t measurement, const CandidateMaterial& material,
                        const SphereLaws& laws) const;
  const SphereLaws& laws_of(const CandidateMaterial& material) const;
  std::vector<double> likely_yield_stresses() const;
  /// An end of the method's range, and the logarithm of how far beyond it a material lies.
  struct Limit
  {
    enum class Kind { stiffest, softest, hardest, deepest, modulus, parameter_low, parameter_high };
    Kind kind;
    double outside;
    Parameter parameter{};
  };
  std::vector<Limit> limits(const CandidateMaterial& material, double beyond) const;
  std::string sentence(const Limit& limit) const;
  /// Of the data, in their order: no loss has tempered them yet.
  struct Misses
  {
    std::vector<double> data;
    double beyond = 0;  ///< Prediction::beyond, the largest
  };
  Misses misses(const Coordinates& q, const CandidateMaterial& material) const;
  /// Priors and the model's own errors.
  std::vector<double> informed_residuals(const Coordinates& q, const CandidateMaterial& material) const;

  CalibrationRequest request_;
  mutable SphereLawsCache laws_;
  std::vector<std::unique_ptr<WallModel>> walls_;          ///< by measurement; null: rigid
  std::vector<std::unique_ptr<IndenterModel>> indenters_;  ///< by measurement; null: it is of another kind
  std::vector<Unknown> unknowns_;
  std::size_t data_ = 0;
};

}  // namespace granulaw
