#pragma once

#include <vector>

#include "characterise/run/build_runs.hpp"
#include "characterise/run/sampling_plan.hpp"
#include "law/law.hpp"

namespace granulaw {

/// sqrt(I) of impacts that show a law's errors: half-way between impacts that took part, where the law is
/// farthest from its runs; `count` of these intervals, evenly spread. `impacts` ascend; the law's axis ends
/// at `fastest`. A rate's intervals go by the logarithm of the speed; inertia's begin at standstill.
std::vector<double> verification_speeds(const std::vector<ContactRecords::Impact>& impacts, double fastest,
                                        AxisTable::By kind, std::size_t count);

/// Replays `law` against fresh impacts at these sqrt(I); its certificate notes the largest errors. Returns
/// the largest as it counts for the tolerance.
double verify(BodyLaw& law, const CharacterisedBody& body, const std::vector<double>& speeds, int cells,
              const RunSource& source, BuildRuns& runs);

}  // namespace granulaw
