#pragma once

#include <cstdint>
#include <limits>

#include "calibrate/problem.hpp"

namespace granulaw {

/// Minimum of the sum of squares.
struct Minimum
{
  Coordinates q;             ///< of all unknowns, in the order of CalibrationProblem::unknowns()
  double cost = 0;           ///< sum of squared residuals
  Eigen::MatrixXd jacobian;  ///< of the residuals, at q
};

/// The answer of the data on one parameter, SI. An end that no data determine is the end of what is allowed.
struct Interval
{
  double low = 0, high = 0;                ///< Pa of a modulus or stress, m/N of a compliance
  bool low_told = true, high_told = true;  ///< false: no data determine this end
};
/// Profile likelihood of one parameter: all other unknowns are fitted anew at each of its values.
struct ParameterProfile
{
  double value = 0;             ///< of the best fit, in the parameter's SI unit
  Interval within68, within95;  ///< of 68 and 95 % probability
  Coordinates low95, high95;    ///< all unknowns at the ends of the 95 % interval
  std::optional<Coordinates>
      better;  ///< a place with a smaller sum of squares than the minimum's, if one was met
};

/// Intervals of data that scatter more than was stated.
struct Widening
{
  double scale = 1;                                          ///< of chi^2
  double degrees = std::numeric_limits<double>::infinity();  ///< of freedom that the scale is known by
  /// Square root of the rise of chi^2 at the ends of an interval of this probability: Student's t.
  double deviations(double probability) const;
};

/// A systematic difference between data and fit that has a name.
struct Misfit
{
  std::string source;    ///< the measurement's; empty: between several
  std::string name;      ///< in one or two words; of values that are no pattern: misfit_of_outliers
  std::string sentence;  ///< the difference, and its likely causes
};

inline constexpr const char* misfit_of_outliers = "outliers";

/// The answer of the data on a parameter, in one word.
enum class Told {
  value,        ///< an interval
  from_below,   ///< it is larger than the interval's low end; nothing else
  from_above,   ///< it is smaller than the high end; nothing else
  nothing,      ///< neither end of the interval is determined
  at_bound,     ///< the fit lies at an end of the method's range: neither value nor interval
  not_followed  ///< no parameters follow the data: neither value nor interval
};
/// "value", "from below", ..., "not determined".
const char* name_of(Told told);

/// A parameter of the request, with its value, intervals and what the data say of it.
struct FittedParameter
{
  Parameter parameter;
  ParameterProfile profile;
  Told told = Told::value;  ///< which parts of the profile mean something
  bool identifiable() const { return told == Told::value; }
};

/// The answer of a fit.
struct Calibration
{
  CandidateMaterial material;               ///< of the best fit, SI; no material where has_values() is false
  std::vector<FittedParameter> parameters;  ///< in the order of CalibrationRequest::fit
  Eigen::MatrixXd correlation;              ///< of the parameters, in their order
  std::string bound;     ///< the end of the method's range at which the fit lies; empty: within
  bool followed = true;  ///< some parameters follow the data, but for noise and the model's own error
  double chi_squared = 0, p_value = 1;  ///< of the best fit: chance that noise alone makes chi^2 so large
  long degrees_of_freedom = 0;          ///< data less fitted unknowns
  Widening widening;                    ///< of the intervals
  std::vector<MachineState> machines;   ///< by measurement
  /// By measurement: of the machine's compliance, m/N, 95 %; none where it is not fitted.
  std::vector<std::optional<Interval>> compliances;
  /// Relative change of a Young's modulus fitted to curves of machines that are taken as rigid, by a
  /// compliance of stiff_machine, to first order.
  double machine_shift = 0;
  std::vector<Misfit> misfits;  ///< empty: the differences have no pattern
  Minimum minimum;

  /// False: the fit lies at an end of the range, or nothing follows the data. Look at `verdict` then.
  bool has_values() const { return bound.empty() && followed; }
};

/// m/N: a stiff laboratory frame gives way by 1 mm at 100 kN.
inline constexpr double stiff_machine = 1e-8;

/// Fits, profiles, looks for misfits.
Calibration calibrate(const CalibrationProblem& problem);
/// The same from a minimum that is known.
Calibration calibrate(const CalibrationProblem& problem, const Coordinates& start);

/// A parameter is identifiable if its 95 % interval ends on both sides and is narrower than a factor of 1.5
/// (hardening: of 1 + 2 H/Y); else bounded on the side where it ends.
Told told_by(const CalibrationProblem& problem, std::size_t unknown, const ParameterProfile& profile);

/// The fit's values of one measurement at the ends of the 95 % intervals.
struct Band
{
  std::vector<double> low, high;  ///< one of each datum, in its SI unit
};
/// Band of a measurement's prediction. One parameter: the fits at both ends of its interval. Several: their
/// departures h from the fit, over the square root of h' R^-1 h with the correlations R, as an ellipsoid that
/// touches all intervals has. Empty if there are none.
Band band_of(const CalibrationProblem& problem, const Calibration& calibration, std::size_t measurement);

/// Values, bounds and misfits as sentences; the last of all says whether the model fits.
std::string verdict(const CalibrationProblem& problem, const Calibration& calibration);

/// Materials drawn from the posterior: a random walk (Metropolis) over the likelihood from the best fit,
/// every draw independent of the one before as far as twenty steps make it so. The same seed gives the same.
std::vector<CandidateMaterial> draw_materials(const CalibrationProblem& problem,
                                              const Calibration& calibration, int count, std::uint32_t seed);

}  // namespace granulaw
