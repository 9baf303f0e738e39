#pragma once

#include <Eigen/Dense>
#include <functional>
#include <memory>
#include <optional>

#include "calibrate/measurement.hpp"
#include "calibrate/parameters.hpp"

namespace granulaw {

/// Standard deviations on either side of the mean that hold 95 %.
inline constexpr double normal95 = 1.959964;

class Atlas;
class ComposedModel;
class SphereLaws;
class SphereLawsCache;
struct LawShape;
struct MachineState;
struct Prediction;

/// Parameters to be found, and the data. SI.
struct CalibrationRequest
{
  std::vector<Measurement> measurements;  ///< with all standard deviations
  CandidateMaterial known;  ///< density and nu; of what is not fitted, its value; of what is, ignored
  std::vector<Parameter> fit;
  std::vector<ParameterRange> priors, bounds;
  bool robust = true;   ///< outliers count in proportion to their distance, not to its square
  bool planned = false;  ///< single values are candidates, each of which counts alone

  bool fits(Parameter parameter) const;
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
  ~CalibrationProblem();

  const CalibrationRequest& request() const { return request_; }
  SphereLawsCache& laws() const { return *laws_; }
  /// The first measurement whose law is this one's, to about the same depth: both have one error of the model.
  std::size_t sharer(std::size_t measurement) const { return sharers_[measurement]; }
  /// Model of the measurement's two bodies; null: it has one.
  const ComposedModel* composed(std::size_t measurement) const { return composed_[measurement].get(); }

  /// A place of the unknowns.
  struct Unknown
  {
    std::optional<Parameter> parameter{};
    double MachineState::*machine = nullptr;  ///< an offset or a compliance
    std::optional<std::size_t> unloading{};   ///< of the measurement: MachineState::beyond
    std::size_t measurement = 0;              ///< of an unknown that is no parameter
    double scale = 1;                         ///< unit; of the hardening: Y_ref/2
    double step = 1e-3;                       ///< of a coordinate, for differences
    double least = -std::numeric_limits<double>::infinity(), most = -least;  ///< coordinates

    bool is_model_error() const { return !parameter && !machine && !unloading; }
    bool is_hardening() const { return parameter == Parameter::hardening_modulus; }
  };
  const std::vector<Unknown>& unknowns() const { return unknowns_; }
  std::size_t count() const { return unknowns_.size(); }
  std::size_t data_count() const { return data_; }
  /// Unknowns but for the model's own errors.
  std::size_t fitted_count() const;

  CandidateMaterial material(const Coordinates& q) const;
  MachineState machine(const Coordinates& q, std::size_t measurement) const;
  double value(std::size_t unknown, double q) const;  ///< SI
  double coordinate(std::size_t unknown, double value) const;
  /// Ends of what the atlas, the bounds and the data allow the unknown, all others at q, as coordinates.
  Range allowed(std::size_t unknown, const Coordinates& q) const;

  /// Residuals: (measured - predicted)/sd for each datum; priors; model errors; walls.
  Eigen::VectorXd residuals(const Coordinates& q) const;
  /// One measurement's prediction, without and with the model's own errors, and the sd of its data: of noise,
  /// of Prediction::scatter, of both.
  struct Comparison
  {
    std::vector<double> predicted, with_errors, noise, scatter, sd;
    std::vector<double> place;  ///< Prediction::place
    double beyond = 0;          ///< Prediction::beyond
  };
  Comparison compare(const Coordinates& q, std::size_t measurement) const;
  /// Scatter of data, priors and model errors about the fit, as the loss counts it.
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
  Comparison compare(const Coordinates& q, std::size_t measurement, const CandidateMaterial& material,
                     const SphereLaws& laws) const;
  std::vector<double> likely_yield_stresses() const;
  void check_count() const;
  /// Calls use(logarithm of how far beyond an end of the method's range a material lies, sentence on it) for
  /// each end.
  using Sentence = std::function<std::string()>;
  void limits(const CandidateMaterial& material, double beyond,
              const std::function<void(double outside, const Sentence&)>& use) const;
  /// Residuals of the data, in their order, before any loss has tempered them.
  struct Misses
  {
    std::vector<double> data;
    double beyond = 0;  ///< Prediction::beyond, the largest
  };
  Misses misses(const Coordinates& q, const CandidateMaterial& material) const;
  /// Priors and the model's own errors.
  std::vector<double> informed_residuals(const Coordinates& q, const CandidateMaterial& material) const;

  CalibrationRequest request_;
  std::unique_ptr<SphereLawsCache> laws_;
  std::vector<std::size_t> sharers_;                      ///< by measurement
  std::vector<std::unique_ptr<ComposedModel>> composed_;  ///< by measurement
  std::vector<Unknown> unknowns_;
  std::size_t data_ = 0;
};

}  // namespace granulaw
