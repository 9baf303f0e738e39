#pragma once

#include <functional>
#include <string>
#include <vector>

#include "liggghts_plugin/contact/contact_pieces.hpp"
#include "liggghts_plugin/contact/normal_physics.hpp"
#include "liggghts_plugin/contact/pair_table.hpp"
#include "liggghts_plugin/deck/session.hpp"

// Reading of `pair_style gran` and `fix wall/gran` with a model of ours: our keywords into a Setup, the
// others to LIGGGHTS.
namespace granulaw::plugin {

/// Parts of a command that depend on its models.
struct CommandModels
{
  ModelInfo normal;
  void (*read_keywords)(LAMMPS_NS::LAMMPS* lmp, Setup& setup);  ///< NormalPhysics::read_keywords; null: for a plan
  ModelIds ids;
};

/// Runs `work`; what it throws ends the run on all ranks with one sentence. Nothing that a single rank may
/// fail at is thrown here without the ranks having agreed on it (load_law).
template <class Work>
void guarded(LAMMPS_NS::LAMMPS* lmp, Work&& work)
{
  try {
    work();
  } catch (const std::exception& failure) {
    stop_all(lmp, failure.what());
  }
}

/// Common part of the pair style and the walls of ours: the command's setup, its place in the session.
class CommandStyle : public CountedStyle
{
 public:
  CommandStyle(const CommandStyle&) = delete;
  CommandStyle& operator=(const CommandStyle&) = delete;
  ~CommandStyle() override;
  const ContactInquiry* contacts() const override { return setup_.contacts; }

 protected:
  /// `wall`: null for pairs.
  CommandStyle(LAMMPS_NS::LAMMPS* lmp, FixWallGran* wall);

  /// Reads our own words of the command; `call(nargs, args)` gets the others. Ends the run with one sentence where they are wrong. Collective.
  template <NormalPhysics Physics>
  void read(std::int64_t hash, int nargs, char** args, const std::function<void(int, char**)>& call)
  {
    guarded(lmp_, [&] {
      read({model_info<Physics>, &Physics::read_keywords, ModelIds::of(hash)}, nargs, args, call);
    });
  }
  /// The same for a plan: the words are checked, no file is read, no contact is computed.
  void plan(const ModelInfo& normal, std::int64_t hash, int nargs, char** args);
  /// Before each run: `init` is LIGGGHTS's own. Collective.
  void begin_run(const std::function<void()>& init);

  const Setup& setup() const { return setup_; }
  OpenContact open_contact(int itype, int jtype, int i, int j, double weight, double radius_j,
                           double* history) const
  {
    return {pair_key(setup_, itype, jtype),
            i,
            j,
            weight,
            {itype, jtype, lmp_->atom->radius[i], radius_j, 0.0, history}};
  }

 private:
  void read(const CommandModels& models, int nargs, char** args,
            const std::function<void(int, char**)>& call);

  LAMMPS_NS::LAMMPS* lmp_;
  Setup setup_;
};

}  // namespace granulaw::plugin
