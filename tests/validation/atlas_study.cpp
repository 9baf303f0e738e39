// How right is the atlas where it was not made? Random materials and speeds of its range (check_atlas() in
// atlas_build.hpp says how they are drawn), each against a fresh impact, run as `mpm impact` would:
//
//   atlas_study FOLDER --atlas ATLAS.h5 [--count N] [--seed N] [--threads N]
//
// Runs are kept in FOLDER and not made again; a larger --count begins with the same materials. With the seed
// that `mpm atlas` drew the atlas's own checks with (1 if not given) nothing new would be learned.
//
// Exit 0: the certificate of its laws is true of F_max and of e in at least 95 % of the impacts, and no error
// exceeds twice what it claims.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <vector>

#include "characterise/atlas_file.hpp"
#include "base/error.hpp"
#include "characterise/atlas_build.hpp"

namespace {

using namespace granulaw;

/// Magnitudes of one kind of error against what is claimed and what is wanted of it.
struct Errors
{
  const char* name;
  double claimed, wanted;
  std::vector<double> all{};

  void add(double signed_error) { all.push_back(std::abs(signed_error)); }
  double share_within(double bound) const
  {
    const auto within = std::count_if(all.begin(), all.end(), [&](double x) { return x <= bound; });
    return static_cast<double>(within) / static_cast<double>(all.size());
  }
  double worst() const { return *std::max_element(all.begin(), all.end()); }
  bool certificate_holds() const { return share_within(claimed) >= 0.95 && worst() <= 2 * claimed; }

  void print() const
  {
    std::vector<double> sorted = all;
    std::sort(sorted.begin(), sorted.end());
    fmt::print(
        "{:5s} median {:.4f}, 95 % {:.4f}, worst {:.4f}; within {:g}: {:.1f} %; certificate {:.4f}: true in "
        "{:.1f} %, worst {:.2f} of it\n",
        name, sorted[sorted.size() / 2], sorted[(sorted.size() - 1) * 95 / 100], worst(), wanted,
        100 * share_within(wanted), claimed, 100 * share_within(claimed), worst() / claimed);
  }
};

bool study(const std::string& folder, const std::string& file, int count, unsigned seed, int threads)
{
  const Atlas atlas = read_atlas(file);
  ThreadFarm farm(threads, RunCache(folder));
  Errors force{"F_max", atlas.claimed_force(), 0.01}, restitution{"e", atlas.claimed_restitution(), 0.005};
  fmt::print("    E*/Y     nu     H/E  sqrt(I)      F_max        e  solver's own estimate\n");
  for (const AtlasCheck& c : check_atlas(atlas, farm, count, seed, {})) {
    force.add(c.error_force), restitution.add(c.error_restitution);
    const bool beyond = force.all.back() > force.wanted || restitution.all.back() > restitution.wanted;
    fmt::print("{:8.1f}  {:.3f}  {:.4f}  {:.5f}  {:+7.2f} %  {:+.4f}  {:.2f} %{}\n", c.material.stiffness,
               c.material.poisson_ratio, c.material.hardening, c.speed, 100 * c.error_force,
               c.error_restitution, 100 * c.solver_estimate, beyond ? "  <" : "");
  }
  fmt::print("{} impacts, seed {}\n", count, seed);
  force.print();
  restitution.print();
  return force.certificate_holds() && restitution.certificate_holds();
}

}  // namespace

int main(int argc, char** argv)
{
  CLI::App app("The atlas against fresh impacts of random materials");
  std::string folder, atlas;
  int count = 200, threads = 1;
  unsigned seed = 2;
  app.add_option("folder", folder)->required();
  app.add_option("--atlas", atlas)->required();
  app.add_option("--count", count)->check(CLI::Range(1, 100000))->capture_default_str();
  app.add_option("--seed", seed)->capture_default_str();
  app.add_option("--threads", threads)->check(CLI::Range(1, 256))->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    return study(folder, atlas, count, seed, threads) ? 0 : 1;
  } catch (const Error& error) {
    fmt::print(stderr, "atlas_study: {}\n", error.what());
    return 2;
  }
}
