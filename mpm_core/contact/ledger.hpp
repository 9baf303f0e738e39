#pragma once

#include <array>
#include <cstddef>

namespace granulaw {

/// Mechanisms that dissipate the work on a contact.
enum class Mechanism : std::size_t { plastic, waves, friction, shear, adhesion, count };

/// A mechanism in words. Sums over ranks, restart files, JSON, thermo values and the line at a run's end
/// follow from this list.
struct MechanismText
{
  Mechanism which;
  const char* key;     ///< in JSON, J
  const char* words;   ///< in tables
  bool in_statistics;  ///< false: LIGGGHTS's contacts book it as other work
  bool shown_if_zero;  ///< in tables
};
inline constexpr std::array mechanisms{
    MechanismText{Mechanism::plastic, "normal_dissipation_J", "dissipated by normal contacts, J", true, true},
    MechanismText{Mechanism::waves, "wave_dissipation_J", "taken by waves, J", true, false},
    MechanismText{Mechanism::friction, "friction_dissipation_J", "taken by friction, J", false, false},
    MechanismText{Mechanism::shear, "shear_dissipation_J", "dissipated by shear and turning of dents, J", true, false},
    MechanismText{Mechanism::adhesion, "adhesion_dissipation_J", "dissipated by adhesion, J", true, false},
};
static_assert(mechanisms.size() == static_cast<std::size_t>(Mechanism::count));

/// J, taken by each mechanism.
struct Ledger
{
  std::array<double, mechanisms.size()> taken{};

  double& operator[](Mechanism m) { return taken[static_cast<std::size_t>(m)]; }
  double operator[](Mechanism m) const { return taken[static_cast<std::size_t>(m)]; }
};

}  // namespace granulaw
