#pragma once

#include <string>

#include "deck/meeting.hpp"

namespace granulaw::deck {

struct PlanOptions;

/// Largest overlap, m, of a head-on collision, and what it is by: "law", "Thornton" or "Hertz".
struct Overlap
{
  double value = 0;
  std::string basis;
};
/// By the law at hand, else by Hertz. m_eff: kg; speed: m/s, above 0.
Overlap overlap_of(const PlanOptions& options, const Meeting& meeting, double r_eff, double m_eff, double speed);

/// e of the same; 1 without a law.
double restitution_of(const PlanOptions& options, const Meeting& meeting, double r_eff, double m_eff, double speed);

}  // namespace granulaw::deck
