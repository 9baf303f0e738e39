#include "pair_options.hpp"

namespace granulaw {

void define_pair_options(Options& command, PairAsked& asked)
{
  command.add_option("--pair", asked.pair, "a:b or a:wall; may be left out if the file holds one");
  command.add_option(
      "--radius", asked.radius,
      "radius of the first body, m (default 1e-3; e depends on no radius). A rate-dependent law allows "
      "only the\n"
      "radius that it was made for");
  command.add_option("--radius2", asked.radius2,
                     "radius of the second body, m (default: the first's); inf: a thick deformable wall");
}

}  // namespace granulaw
