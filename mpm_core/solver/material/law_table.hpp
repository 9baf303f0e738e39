#pragma once

#include <string>
#include <vector>

#include "solver/material/laws.hpp"
#include "solver/material/material.hpp"

namespace granulaw {

/// A yield surface or a flow law as the materials file may name it.
struct FlowLawKeys
{
  std::string name;
  std::vector<flow::Parameter> parameters;
};

const std::vector<FlowLawKeys>& yield_surfaces();
const std::vector<FlowLawKeys>& hardening_laws();
const std::vector<FlowLawKeys>& rate_laws();

/// Throws Error naming `where` if the material's laws cannot be used or do not start at its yield stress.
void validate_flow(const Material& material, const std::string& where);

/// The material's laws for the kernels: stresses over `stress` (Pa), rates times `time` (s). Valid materials
/// only.
flow::Flow flow_of(const Material& material, double stress, double time);

/// The material's plastic flow changes its volume.
bool dilates(const Material& material);

/// Static flow stress, Pa, at equivalent plastic strain `ep`; the material yields.
double flow_stress(const Material& material, double ep);

/// The material with every plastic strain of its hardening `by` times as large: its static flow stress at
/// by ep is that of `material` at ep.
Material with_strains_scaled(Material material, double by);

/// Factor on it at a plastic strain rate of `rate`, 1/s; 1 for a rate-independent material.
double rate_factor(const Material& material, double rate);

}  // namespace granulaw
