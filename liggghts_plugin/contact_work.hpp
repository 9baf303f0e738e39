#pragma once

#include "liggghts_plugin/contact_statistics.hpp"

namespace granulaw::plugin {

struct MpmContact;
struct ThorntonContact;
struct Setup;

// What the energy tally needs of a law beyond its force. Overlaps are the contact's own, stretched;
// `impact_overlap` is the latched X.

/// J, elastic energy that a contact holds at overlap `delta`: what it gives back on complete unloading.
double stored_energy(const MpmContact& contact, double r_eff, double delta, double delta_max,
                     double impact_overlap);
double stored_energy(const ThorntonContact& contact, double r_eff, double delta, double delta_max,
                     double impact_overlap);

/// N/m, the stiffest that a contact is which has just reached `delta`: on the way in or back out.
double stiffness(const MpmContact& contact, double r_eff, double delta, double impact_overlap);
double stiffness(const ThorntonContact& contact, double r_eff, double delta, double impact_overlap);

/// What the start-up table and the JSON file say of the law of types i and j. `r_eff` (m) and
/// `m_eff` (kg) are those of the smallest particles that can meet: they give onset_speed and dt_limit. 0: no
/// particle is known.
PairInfo describe(const MpmContact& contact, const Setup& setup, const PairKey& key, double r_eff,
                  double m_eff);
PairInfo describe(const ThorntonContact& contact, const Setup& setup, const PairKey& key, double r_eff,
                  double m_eff);

}  // namespace granulaw::plugin
