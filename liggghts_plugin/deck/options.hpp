#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "contact/damping.hpp"
#include "liggghts_plugin/deck/model_info.hpp"

namespace granulaw::plugin {

/// Viscous damping of contacts where the law is elastic.
struct ElasticDamping
{
  double ratio = usual_elastic_damping;  ///< fraction of critical; an elastic impact then has e = exp(-pi Z/sqrt(1-Z^2))
  bool from_restitution = false;  ///< Z of each pair of types from the deck's coefficientRestitution

  bool operator==(const ElasticDamping&) const = default;
};

/// Fraction of R* at which a stretched contact stops the run: deeper, spheres slip through each other.
inline constexpr double stretched_overlap_limit = 0.5;

/// Response of a contact deeper than the law's table.
enum class BeyondRange { stop, proceed, crush };

/// The plug-in's own keywords in `pair_style gran` and `fix wall/gran`. See
/// docs/reference/pair_gran_model_mpm.md.
struct Options
{
  bool deformable_wall = false;               ///< `wall rigid|deformable` (walls)
  std::optional<double> tangential_damping;   ///< `tangentialDampingRatio Z`: fraction of critical damping
  std::optional<bool> tangential_damping_on;  ///< LIGGGHTS's own `tangential_damping on|off`
  std::optional<bool> tangential_computed;    ///< `tangentialStiffness mindlin|computed`
  std::optional<ElasticDamping> elastic_damping;  ///< `elasticDamping Z|off|restitution`
  std::optional<bool> body_compliance;            ///< `bodyCompliance on|off`: of the body behind a contact
  std::optional<double> stretch;                  ///< `stretch S`: F_s(d) = F(d/S)/S
  std::string stats_path;                 ///< `stats FILE` (pair): JSON written at the end of each run
  bool energy = false;                    ///< `energy on|off` (pair): energies per particle, friction
  bool dissipated_energy = false;         ///< LIGGGHTS's own `computeDissipatedEnergy on|off`
  bool contact_map = false;               ///< `contactMap on|off` (pair): counts of speed and overlap, joint
  std::optional<BeyondRange> beyond_range;  ///< `beyondRange stop|continue|crush` (models with a table)
  std::optional<bool> heat_by_law;        ///< `heatArea overlap|law`: the area that heat passes through

  /// Each of the model's own keywords that was said, with the words behind it.
  std::map<std::string, std::vector<std::string>> own;

  bool operator==(const Options&) const = default;
  /// The words behind one of the model's own keywords; none: it was not said.
  const std::vector<std::string>& own_words(const std::string& key) const;
  /// Takes options that a wall's command leaves open from the pair style's.
  void inherit(const Options& pair);
};

/// Every keyword that may stand behind the models: the plug-in's own, then those that LIGGGHTS reads.
std::vector<std::string> keyword_names(const ModelInfo& model, bool is_wall);

/// Takes the plug-in's words out of `words` and leaves the rest for LIGGGHTS in `rest`. Throws Error with one
/// sentence that starts with `where` on an unknown or misplaced word, a missing or bad value.
Options parse_options(const ModelInfo& model, bool is_wall, const std::string& where,
                      const std::vector<std::string>& words, std::vector<std::string>& rest);

}  // namespace granulaw::plugin
