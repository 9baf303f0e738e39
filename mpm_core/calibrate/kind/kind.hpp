#pragma once

#include <limits>

#include "calibrate/atlas_errors.hpp"
#include "calibrate/measurement.hpp"
#include "calibrate/sphere_laws.hpp"

namespace granulaw {

struct CalibrationRequest;
class ComposedModel;
class Inspection;

/// A column of a file: "velocity_m_per_s" is the quantity with its unit.
struct Column
{
  const char* quantity = "";  ///< none: the kind has no such column
  const char* unit = "";      ///< SI; none: a pure number
  double above = 0;           ///< each value is larger
  const char* allowed = "over 0";
  double most = std::numeric_limits<double>::infinity();  ///< no value is larger, but for noise

  bool exists() const { return *quantity; }
  std::string name() const { return *unit ? std::string(quantity) + "_" + unit : quantity; }
};

/// A material that is held against a measurement.
struct Trial
{
  const CandidateMaterial& material;
  const SphereLaws& laws;
  MachineState machine{};
  const ComposedModel* composed = nullptr;  ///< of Measurement::is_composed()
};

/// Values that a material would show, and how far the model itself may be off.
struct Prediction
{
  std::vector<double> values;  ///< of Measurement::data
  /// Change of the values by one standard deviation of each of the model's own errors. An error of the
  /// model is a smooth function of speed or overlap, no scatter: Legendre polynomials, whose factors a fit
  /// has for unknowns of mean 0.
  std::vector<std::vector<double>> errors;
  std::vector<double> scatter;  ///< sd of the rest of that error
  /// Places of the values, in lengths over which that rest is correlated; none: it differs from value to value.
  std::vector<double> place{};
  double beyond = 0;            ///< ln of how far the data are beyond the atlas's end; 0: within
};

/// Range of the data, for a material.
struct Reach
{
  double slowest = std::numeric_limits<double>::infinity(), fastest = 0;  ///< impacts, over V_y
  double overlap = 0;             ///< largest, of one contact over its R*
  double overlap_over_onset = 0;  ///< curves: the same over that of first yield
};

/// A kind of measurement: its file, its model, its patterns. A new one is a file beside impacts.cpp, its line
/// in kinds.cpp and its row in docs/guide/calibrate.md.
struct Kind
{
  const char* name = "";       ///< in --json
  const char* word = nullptr;  ///< of --kind, where columns alone do not name the kind
  const char* help = "";       ///< a clause: the columns' meaning
  Column x{}, y{};
  double contacts = 1;         ///< that share the displacement
  bool needs_density = false;  ///< of the sphere
  bool has_machine = false;    ///< a machine, with an offset, a compliance and a turn (MachineState)
  enum class Counterpart { none, wall, indenter } counterpart = Counterpart::none;
  /// The strength that is shown: that of fast impacts, of slow presses, or neither for certain.
  enum class Shows { neither, fast, slow } shows = Shows::neither;
  bool has_ratio_to_yield = false;  ///< Measurement::ratio_to_yield may be given
  /// Plastic strain at which a value shows the flow stress of a material; null: the kind shows the flow curve.
  double (*flow_strain)(const CandidateMaterial&) = nullptr;
  std::size_t smooth_errors = 1;    ///< number of Prediction::errors

  /// The model.
  Prediction (*predict)(const Measurement&, const Trial&) = nullptr;
  Reach (*reach)(const Measurement&, const Trial&) = [](const Measurement&, const Trial&) { return Reach{}; };
  /// Adds yield stresses that a material of these data may have, Pa.
  void (*starts)(const Measurement&, const LawMaterial& known, std::vector<double>& likely) = nullptr;

  /// The rows together; and the request of a fit. Throw Error.
  void (*check_rows)(const Measurement&) = [](const Measurement&) {};
  void (*check_request)(const Measurement&, const CalibrationRequest&,
                        const Atlas&) = [](const Measurement&, const CalibrationRequest&, const Atlas&) {};
  /// Standard deviations of values whose file states none: a fraction of the value.
  void (*complete)(Measurement&, double relative_sd) = [](Measurement& m, double relative_sd) {
    for (Datum& d : m.data)
      if (d.sd == 0) d.sd = relative_sd * d.y, d.relative_sd = relative_sd;
  };

  /// Misfits: whether a value depends on the strength; the model's error (sd), of e absolute, else relative;
  /// names the patterns.
  bool (*tells_strength)(const Measurement&, std::size_t row,
                         double predicted) = [](const Measurement&, std::size_t, double) { return true; };
  double (*model_error)(const AtlasErrors&) = [](const AtlasErrors& e) { return e.force; };
  void (*inspect)(Inspection&) = [](Inspection&) {};

  /// Curves: overlap of one contact over its R* at which the kind's law ends.
  double (*deepest)(const Measurement&) = nullptr;
  /// The rows of a measurement that would be made up to a place x, their values still 0; none: one row there,
  /// and rows at several places are one measurement.
  std::vector<Datum> (*planned)(double x) = nullptr;

  /// "velocity_m_per_s,restitution"
  std::string header() const { return (x.exists() ? x.name() + "," : "") + y.name(); }
};

/// The flow stress that a measurement shows, Pa, and its plastic strain.
struct FlowShown
{
  double strain, stress;
};
/// None: the measurement shows the flow curve, or its ratio to the yield stress was given.
std::optional<FlowShown> flow_shown(const Measurement& measurement, const CandidateMaterial& material);

/// Pa, a kilogram-force per square millimetre: the unit of HB and HV.
inline constexpr double kilogram_force = 9.80665e6;

/// All data of a measurement are of one true value; `sd`: of the model.
Prediction same_value(const Measurement& measurement, double value, double sd);

/// Departure of single values from the smooth error, over it: half of its variance.
inline const double rough_share = std::sqrt(0.5);
/// Legendre's polynomials of degree 0 to 2 at t from -1 to 1, each of mean square 1.
void legendre(double t, double out[3]);

}  // namespace granulaw
