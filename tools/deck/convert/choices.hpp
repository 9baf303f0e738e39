#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "deck/convert/convert.hpp"
#include "deck/plan.hpp"

// Choices of a conversion that the deck does not make itself: names of materials, answers, time step, moduli.
namespace granulaw::deck {

/// Atom types of the deck's particles; type 1 where it shows none.
std::set<int> types_of_particles(const Scene& scene);

/// One name for each atom type: as given, as the deck has them, or the one material of the file. `known`: the names in
/// the file `source`. Throws Unanswered where a choice is left.
std::vector<std::string> names_of_types(const Scene& scene, const std::vector<std::string>& given, const std::string& source, const std::vector<std::string>& known);

/// A number from the deck, no less than what its plan knows already, and where it comes from; 0: there is none.
struct DefaultAnswer
{
  double value = 0;
  std::string reason;
};
DefaultAnswer default_answer(const Scene& scene, const Plan& plan, const std::string& option);

/// Questions whose answer changes the conversion.
std::vector<Question> open_questions(const Plan& plan);
std::string question_sentence(const Scene& scene, const Plan& plan, const std::vector<Question>& questions);

/// The deck's time step, and what binds the stretch.
struct StepChoice
{
  double deck_step = 0;  ///< s; 0: nothing moves
  std::string bound;     ///< empty: nothing does
};
/// Sets stretch and step factor of the conversion: the deck's own time step where the limits of soften() allow it.
StepChoice choose_time_step(Conversion& conversion, const PlannedDeck& deck, bool may_stretch);
/// The same with the stretch of the contacts that the deck continues from a restart file.
StepChoice continue_stretch(Conversion& conversion, const PlannedDeck& deck, double stretch);

/// Sets moduli: of `known` names as the law has them; those of rigid walls, which serve friction alone, rise with the
/// particles'.
void choose_moduli(Conversion& conversion, const PlannedDeck& deck, const std::vector<std::string>& known);

}  // namespace granulaw::deck
