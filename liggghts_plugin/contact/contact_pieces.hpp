#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "liggghts_plugin/engine/liggghts.hpp"
#include "liggghts_plugin/engine/shapes.hpp"

// The models of LIGGGHTS that stand beside a normal model of ours: tangential, cohesion, rolling.
namespace granulaw::plugin {

/// Ids of the five models that make a contact, packed as LIGGGHTS packs them: six bits each.
struct ModelIds
{
  int normal, tangential, cohesion, rolling, surface;

  static ModelIds of(std::int64_t hash)
  {
    const auto part = [hash](int place) { return static_cast<int>(hash >> 6 * place & 63); };
    return {part(0), part(1), part(2), part(3), part(4)};
  }
  std::int64_t hash() const
  {
    return LIGGGHTS::Utils::generate_gran_hashcode(normal, tangential, cohesion, rolling, surface);
  }
  bool superquadric() const { return surface == cm::SURFACE_SUPERQUADRIC; }
  /// Liquid bridges pull across a gap.
  bool has_bridges() const
  {
    return cohesion == cm::COHESION_EASO_CAPILLARY_VISCOUS ||
           cohesion == cm::COHESION_WASHINO_CAPILLARY_VISCOUS;
  }
};

/// A model that the deck names, behind its base class; none where it is off.
template <class Base>
class Chosen
{
 public:
  Chosen(LAMMPS* lmp, LIGGGHTS::IContactHistorySetup* hsetup, cm::ContactModelBase* contact, int id)
      : model_(make(lmp, hsetup, contact, id))
  {
  }
  explicit operator bool() const { return model_ != nullptr; }
  Base* operator->() { return model_.get(); }

 private:
  /// contact_pieces.cpp
  static std::unique_ptr<Base> make(LAMMPS* lmp, LIGGGHTS::IContactHistorySetup* hsetup,
                                    cm::ContactModelBase* contact, int id);
  std::unique_ptr<Base> model_;
};

/// A model that is off.
template <class Base>
class Off
{
 public:
  static constexpr bool always_off = true;
  Off(LAMMPS*, LIGGGHTS::IContactHistorySetup*, cm::ContactModelBase*, int) {}
  constexpr explicit operator bool() const { return false; }
  Base* operator->() { return nullptr; }
};

/// A piece of ours, for describe_pieces. `place`: &ModelIds::tangential or cohesion.
void name_piece(int ModelIds::*place, int id, const char* name);
/// True: models of ours can be combined so.
bool is_built(const ModelIds& ids);
/// Calls visit for every combination with this normal model that LIGGGHTS can name.
void each_combination(int normal, const std::function<void(const ModelIds&)>& visit);
/// One sentence that says which combinations are built.
std::string built_combinations();
/// " cohesion sjkr rolling_friction cdt": what of these is not off.
std::string describe_pieces(const ModelIds& ids);

}  // namespace granulaw::plugin
