#pragma once

#include <string>
#include <vector>

#include "solver/runs.hpp"

/// Convergence of results as cells and time steps shrink. Units R = rho = E* = 1, nu = 0.3.
namespace granulaw::verification {

struct Job
{
  std::string name;
  Particle sphere;
  double velocity;
};
Job elastic_impact();  ///< the one that Hertz's theory stops at 0.002 R
Job plastic_impact();  ///< E*/Y = 100, V/V_y = 100

/// `shifted_grids`: shifted grids whose mean is taken; 1: a single grid.
RunSummary run(const Job& job, int cells_across, int shifted_grids, double courant = 0.85);

/// A sphere that vibrates freely, without contact: largest deviation of kinetic plus elastic energy during 20
/// R/c*, some eight periods of the slowest mode, over what it began with. It starts undeformed with the
/// velocity of a uniform axial strain rate. Kinetic energy at the moments of the displacements, from the mean
/// of the velocities half a step before and after.
double energy_swing(double courant);

/// Least squares of ln(error) = ln(c) - p ln(cells).
struct Order
{
  double p, standard_error;
};
Order fit_order(const std::vector<int>& cells, const std::vector<double>& errors);

/// Least squares of value = limit + c cells^-p; p by search between 0.5 and 4.
struct Limit
{
  double value, p;
};
Limit fit_limit(const std::vector<int>& cells, const std::vector<double>& values);

double root_mean_square(const std::vector<double>& errors);

}  // namespace granulaw::verification
