#include "calibrate/parameters.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/material/law_table.hpp"

namespace granulaw::parameters_test {

/// A material of this law, at the start of a search.
CandidateMaterial begun(const std::string& law)
{
  CandidateMaterial m = LawMaterial{"stone", 2000, 10e9, 0.25, 60e6, 0};
  if (law != flow::Linear::name) m.hardening.name = law;
  for (const Parameter p : parameters_of(law)) set_value(m, p, start_of(m, p, 0.6, 0.1));
  return m;
}

TEST(Parameters, OfEachLawThatTheSolverHas)
{
  for (const std::string& law : fitted_hardening_laws()) {
    const CandidateMaterial m = begun(law);
    EXPECT_FALSE(parameters_of(law).empty()) << law;
    for (const Parameter p : parameters_of(law)) {
      EXPECT_EQ(parameter_named(name_of(p), "test"), p);
      EXPECT_GT(value_of(m, p), range_of(m, p).low) << law << ' ' << name_of(p);
      EXPECT_LT(value_of(m, p), range_of(m, p).high) << law << ' ' << name_of(p);
    }
    // the solver takes it, and it starts at the yield stress (to rounding)
    EXPECT_NO_THROW(validate_flow(solver_material(m), "test")) << law;
    EXPECT_NEAR(flow_stress(solver_material(m), 0) / m.yield_stress, 1, 1e-12) << law;
    EXPECT_GT(flow_stress(solver_material(m), 0.1), 1.01 * m.yield_stress) << law;
  }
}

}  // namespace granulaw::parameters_test
