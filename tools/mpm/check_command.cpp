// mpm check: is this file a whole, sane, admissible law, and does the solver still agree with it?
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <random>

#include "base/error.hpp"
#include "characterise/check/check_law.hpp"
#include "collision_report.hpp"
#include "command.hpp"
#include "law/law_file.hpp"
#include "material_file/materials_file.hpp"
#include "option_checks.hpp"
#include "shape_output.hpp"
#include "terminal.hpp"

namespace granulaw {

namespace of_check {

struct CheckRequest
{
  std::string law, materials;
  int impacts = 2;
  unsigned seed = 0;
};

void print(const FreshImpact& found)
{
  fmt::print("{}: impact at {:.4g} m/s: F off by {} (bound {}), e by {} (bound {}): {}\n", found.name, found.velocity, percent(found.force), percent(found.bound.force),
      percent(found.restitution), percent(found.restitution_bound), found.agrees() ? "good" : "NOT GOOD: more than twice the bound");
}

void check(const CheckRequest& r)
{
  const Law law = read_law(r.law);
  std::optional<MaterialsFile> materials;
  if (!r.materials.empty()) materials = read_materials(r.materials);
  const unsigned seed = r.seed ? r.seed : std::random_device{}();
  ProgressBar bar;
  const LawCheck found = check_law(
      law, {r.law, materials ? &*materials : nullptr, r.impacts, seed}, [&](double done, const std::string& what) { bar.update(done, what); },
      [&](const FreshImpact& impact) {
        bar.clear();
        print(impact);
      });
  bar.clear();
  for (const std::string& name : found.skipped)
    fmt::print("{}: no fresh impacts: its materials' numbers alone do not determine its law; name the file it was made from with --materials-file\n", name);
  for (const auto& [name, body] : law.bodies)
    if (body.shape) print_shape(name, *body.shape);
  if (!found.agrees()) fail(r.law, fmt::format("the law fails its check (seed {})", seed));
  fmt::print("{}: good ({} materials, pairs {}; no closed cycle gains energy; {} fresh impacts in all, seed {})\n", r.law, law.bodies.size(), law.pair_list(),
      found.impacts.size(), seed);
}

void define(Options& command)
{
  const auto r = std::make_shared<CheckRequest>();
  command.add_option("LAW", r->law, "law file of mpm table").required();
  command.add_option("--impacts", r->impacts, "fresh impacts for each yielding material (default 2; 0: none)").check(whole_from_to(0, 1000));
  command.add_option("--materials-file,--materials", r->materials,
      "materials file that the law was made from: needed for the impacts of layered, shaped, rate-dependent and nonlinearly hardening bodies");
  command.add_option("--seed", r->seed, "seed of the velocities (default: a new one each time, printed)");
  command.callback([r] { check(*r); });
}

}  // namespace of_check

extern const Command check_command{"check",
    "Checks a law file: that it is complete, conserves energy, and agrees with new solver runs.\n"
    "The runs are impacts at random velocities within the range of the law. They are of each yielding\n"
    "material on a wall, and of the two bodies of each pair with a pair law. Force and e must lie within twice the error bound.\n"
    "Example: mpm check law.h5",
    of_check::define};

}  // namespace granulaw
