#include "calibrate/fit.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>

#include <algorithm>
#include <memory>

#include "base/error.hpp"

namespace granulaw {

namespace {

/// The free unknowns of a problem, for GSL.
struct FreeProblem
{
  const CalibrationProblem& problem;
  Coordinates q;                   ///< fixed unknowns keep these
  std::vector<Eigen::Index> free;  ///< the others' places
  Eigen::Index rows;

  Coordinates at(const gsl_vector* x) const
  {
    Coordinates full = q;
    for (std::size_t k = 0; k < free.size(); ++k) full[free[k]] = gsl_vector_get(x, k);
    return full;
  }
};

int evaluate(const gsl_vector* x, void* data, gsl_vector* f)
{
  const auto& problem = *static_cast<const FreeProblem*>(data);
  const Coordinates q = problem.at(x);
  if (!q.allFinite()) return GSL_EDOM;  // a step along a direction that nothing determines
  const Eigen::VectorXd r = problem.problem.residuals(q);
  if (!r.allFinite()) return GSL_EDOM;
  for (Eigen::Index k = 0; k < r.size(); ++k) gsl_vector_set(f, static_cast<std::size_t>(k), r[k]);
  return GSL_SUCCESS;
}

/// Forward differences over the unknowns' own steps: wide against what tables leave of the model's
/// smoothness.
Eigen::MatrixXd differences(const FreeProblem& p, const Coordinates& q)
{
  const Eigen::VectorXd base = p.problem.residuals(q);
  Eigen::MatrixXd jacobian(base.size(), static_cast<Eigen::Index>(p.free.size()));
  for (std::size_t k = 0; k < p.free.size(); ++k) {
    const double step = p.problem.unknowns()[static_cast<std::size_t>(p.free[k])].step;
    Coordinates moved = q;
    moved[p.free[k]] += step;
    jacobian.col(static_cast<Eigen::Index>(k)) = (p.problem.residuals(moved) - base) / step;
  }
  return jacobian;
}

int derive(const gsl_vector* x, void* data, gsl_matrix* j)
{
  const auto& problem = *static_cast<const FreeProblem*>(data);
  const Eigen::MatrixXd jacobian = differences(problem, problem.at(x));
  if (!jacobian.allFinite()) return GSL_EDOM;
  for (Eigen::Index row = 0; row < jacobian.rows(); ++row)
    for (Eigen::Index column = 0; column < jacobian.cols(); ++column)
      gsl_matrix_set(j, static_cast<std::size_t>(row), static_cast<std::size_t>(column),
                     jacobian(row, column));
  return GSL_SUCCESS;
}

struct FreeWorkspace
{
  void operator()(gsl_multifit_nlinear_workspace* w) const { gsl_multifit_nlinear_free(w); }
};

}  // namespace

Minimum minimise(const CalibrationProblem& problem, const Coordinates& start, const std::vector<bool>& fixed,
                 int most_steps)
{
  gsl_set_error_handler_off();
  FreeProblem free{problem, start, {}, 0};
  for (std::size_t k = 0; k < fixed.size(); ++k)
    if (!fixed[k]) free.free.push_back(static_cast<Eigen::Index>(k));
  free.rows = problem.residuals(start).size();
  Minimum found{start, problem.residuals(start).squaredNorm(), {}};
  if (free.free.empty()) return found;

  gsl_multifit_nlinear_parameters settings = gsl_multifit_nlinear_default_parameters();
  settings.trs = gsl_multifit_nlinear_trs_lm;
  settings.scale = gsl_multifit_nlinear_scale_more;
  settings.solver =
      gsl_multifit_nlinear_solver_svd;  // what the data do not determine leaves the matrix singular
  gsl_multifit_nlinear_fdf functions{};
  functions.f = evaluate, functions.df = derive;
  functions.n = static_cast<std::size_t>(free.rows), functions.p = free.free.size();
  functions.params = &free;
  const std::unique_ptr<gsl_multifit_nlinear_workspace, FreeWorkspace> workspace(
      gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &settings, functions.n, functions.p));
  if (!workspace) fail("calibrate", "not enough memory for the fit");
  gsl_vector* x = gsl_vector_alloc(functions.p);
  for (std::size_t k = 0; k < functions.p; ++k) gsl_vector_set(x, k, start[free.free[k]]);
  int why = 0;
  gsl_multifit_nlinear_init(x, &functions, workspace.get());
  gsl_multifit_nlinear_driver(static_cast<std::size_t>(most_steps), 1e-7, 1e-10, 1e-10, nullptr, nullptr,
                              &why, workspace.get());
  found.q = free.at(gsl_multifit_nlinear_position(workspace.get()));
  gsl_vector_free(x);
  found.cost = problem.residuals(found.q).squaredNorm();
  return found;
}

Minimum best_fit(const CalibrationProblem& problem)
{
  const std::vector<bool> none(problem.count(), false);
  Minimum best;
  bool first = true;
  for (const Coordinates& start : problem.starts()) {
    const Minimum found = minimise(problem, start, none);
    if (first || found.cost < best.cost) best = found;
    first = false;
  }
  return polished(problem, best.q);
}

Minimum polished(const CalibrationProblem& problem, const Coordinates& start)
{
  constexpr int most_rounds = 5;
  constexpr double no_gain = 1e-3;  // of the sum of squares: a thousandth of what a 68 % interval takes
  const std::vector<bool> none(problem.count(), false);
  Minimum best = minimise(problem, start, none);
  for (int round = 0; round < most_rounds; ++round) {
    Minimum next = minimise(problem, best.q, none);
    const double gain = best.cost - next.cost;
    if (gain > 0) best = std::move(next);
    if (gain < no_gain) break;
  }
  best.jacobian = jacobian_at(problem, best.q);
  return best;
}

Eigen::MatrixXd jacobian_at(const CalibrationProblem& problem, const Coordinates& q)
{
  FreeProblem all{problem, q, {}, 0};
  for (std::size_t k = 0; k < problem.count(); ++k) all.free.push_back(static_cast<Eigen::Index>(k));
  return differences(all, q);
}

Eigen::MatrixXd covariance(const Minimum& minimum)
{
  Eigen::MatrixXd information = minimum.jacobian.transpose() * minimum.jacobian;
  information.diagonal().array() += 1e-6;
  return information.inverse();
}

}  // namespace granulaw
