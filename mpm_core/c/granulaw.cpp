#include "c/granulaw.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "base/version.hpp"
#include "c/law_handle.hpp"
#include "contact/adhesion.hpp"
#include "contact/damping.hpp"
#include "contact/element.hpp"
#include "contact/plastic_shear.hpp"
#include "contact/tabulated.hpp"
#include "law/law_file.hpp"
#include "law/size_choice.hpp"
#include "law/stated_collision.hpp"

using namespace granulaw;

struct granulaw_law
{
  std::shared_ptr<const Law> law;
  std::vector<const LawMaterial*> materials;
};

namespace {

/// The law of one ratio of sizes.
template <class Element>
struct SizedLaw
{
  PairLaw law;
  Element element;
  double largest_overlap;  // over R*
};
template <class Tangential, class Beside = NothingBeside>
using SizedLaws = std::vector<SizedLaw<ContactElement<Tabulated, Tangential, Beside>>>;

}  // namespace

struct granulaw_contact_law
{
  std::shared_ptr<const Law> law;  // its curves are the elements'
  PairNames names;
  Scale scale;
  SizeChoice choice;
  LawFinder finder;
  std::variant<SizedLaws<Frictionless>, SizedLaws<Spring>, SizedLaws<PlasticShear>, SizedLaws<Frictionless, DentAdhesion>,
               SizedLaws<Spring, DentAdhesion>>
      laws;
};

static_assert(GRANULAW_MECHANISMS == static_cast<int>(Mechanism::count));
static_assert(GRANULAW_PLASTIC == static_cast<int>(Mechanism::plastic) &&
              GRANULAW_WAVES == static_cast<int>(Mechanism::waves) &&
              GRANULAW_FRICTION == static_cast<int>(Mechanism::friction) &&
              GRANULAW_SHEAR == static_cast<int>(Mechanism::shear) &&
              GRANULAW_ADHESION == static_cast<int>(Mechanism::adhesion));

namespace {
int failed(int code, granulaw_why* why, std::string_view sentence)
{
  if (why) {
    const std::size_t length = std::min(sentence.size(), sizeof why->text - 1);
    std::copy_n(sentence.begin(), length, why->text);
    why->text[length] = '\0';
  }
  return code;
}

/// Runs `work`; what it throws is `code` and a sentence.
template <class Work>
int guarded(int code, granulaw_why* why, Work&& work)
{
  try {
    work();
    return GRANULAW_OK;
  } catch (const std::bad_alloc&) {
    return failed(GRANULAW_NO_MEMORY, why, "no memory is left");
  } catch (const std::exception& failure) {
    return failed(code, why, failure.what());
  } catch (...) {
    return failed(code, why, "unknown failure");
  }
}


/// Bytes of a struct in the first version 1: a program that was compiled then has no member behind them.
template <class Struct>
constexpr std::size_t first_size = sizeof(Struct);
template <>
constexpr std::size_t first_size<granulaw_pair> = offsetof(granulaw_pair, work_of_adhesion);
template <>
constexpr std::size_t first_size<granulaw_range> = offsetof(granulaw_range, reach);

/// True if a struct of this size has no value that this library does not know; else false, with a sentence.
template <class Struct>
bool is_known(const Struct* given, granulaw_why* why, const char* name)
{
  if (given->size == sizeof(Struct)) [[likely]]
    return true;
  if (given->size < first_size<Struct>)
    return failed(0, why, std::string(name) + ": its member `size` is not set to sizeof(" + name + ")"), false;
  // a program of a later version says nothing that this library would not do; one of an earlier version has no more
  const auto* bytes = reinterpret_cast<const unsigned char*>(given);
  const std::size_t known = std::min(given->size, sizeof(Struct));
  if (std::any_of(bytes + known, bytes + given->size, [](unsigned char byte) { return byte != 0; }))
    return failed(0, why, std::string(name) + ": it has a member that is unknown to this older library"), false;
  return true;
}

/// The k-th of structs as large as the first, which another version of the header may have.
template <class Struct>
Struct& at(Struct* first, std::size_t k)
{
  using Byte = std::conditional_t<std::is_const_v<Struct>, const char, char>;
  return *reinterpret_cast<Struct*>(reinterpret_cast<Byte*>(first) + k * first->size);
}

/// What the caller's struct is set to, but for its size. Members that it or this library does not know stay.
template <class Struct>
int answer(Struct* to, Struct values)
{
  if (!to) return GRANULAW_NO_POINTER;
  if (to->size < first_size<Struct>) return GRANULAW_NO_SIZE;
  values.size = to->size;
  std::memcpy(to, &values, std::min(to->size, sizeof values));
  return GRANULAW_OK;
}

/// A number of granulaw_pair: 0 stands for `usual`.
double said(double value, double usual)
{
  return value == 0.0 ? usual : value;
}

const char* wrong_number(const granulaw_pair& pair)
{
  const auto positive = [](double value) { return value >= 0 && std::isfinite(value); };
  if (!(pair.radius_a >= 0 && pair.radius_b >= 0) || (pair.radius_a > 0) != (pair.radius_b > 0) || std::isinf(pair.radius_a))
    return "radius_a and radius_b: both over 0, radius_b infinity for a wall, or both 0";
  if (!positive(pair.length) || !positive(pair.mass) || !positive(pair.time))
    return "length, mass and time: over 0, or 0 for SI";
  if (!(pair.stretch == 0 || (pair.stretch >= 1 && std::isfinite(pair.stretch))))
    return "stretch: 1 or more, or 0 for 1";
  if (!positive(pair.friction) || !positive(pair.shear_stiffness) || !positive(pair.shear_damping) ||
      !positive(pair.elastic_damping))
    return "friction, shear_stiffness, shear_damping and elastic_damping: 0 or more";
  if (!positive(pair.work_of_adhesion) || !positive(pair.adhesion_range)) return "work_of_adhesion and adhesion_range: 0 or more";
  if (pair.work_of_adhesion > 0 && pair.yields_in_shear) return "work_of_adhesion: not with yields_in_shear (tangential plastic), as shear would have to pay for the surfaces that it parts";
  return nullptr;
}

/// Moduli of the file's material of this name; a rigid wall is no material.
ElasticBody body_of(const Law& law, const std::string& name)
{
  if (name == wall_name) return {};
  const LawMaterial& material = law.bodies.at(name).material;
  return {material.youngs_modulus, material.poisson_ratio};
}

constexpr double wall_radius = 1e300;  // in place of infinity: its share of a sum is a number

/// 0: unknown.
Radii radii(double radius)
{
  return radius > 0 ? Radii{std::min(radius, wall_radius), std::min(radius, wall_radius)} : Radii{};
}

double r_eff_of(double radius_a, double radius_b)
{
  if (std::isinf(radius_a)) return radius_b;
  return std::isinf(radius_b) ? radius_a : effective_radius(radius_a, radius_b);
}

template <class Tangential, class Beside = NothingBeside>
void make_laws(granulaw_contact_law& contact, const granulaw_pair& pair)
{
  const auto& [a, b] = contact.names;
  const Scale& scale = contact.scale;
  BodiesInShear bodies =
      BodiesInShear::of(body_of(*contact.law, a), body_of(*contact.law, b), pair.shear_damping, scale.pressure());
  bodies.stiffness = said(pair.shear_stiffness, bodies.stiffness);
  const ShearPair spring = ShearPair::of(bodies.stiffness, pair.friction, pair.shear_damping, scale.stretch);
  SizedLaws<Tangential, Beside> laws;
  for (std::size_t k = 0; k < contact.choice.count(); ++k) {
    const bool serves = contact.choice.serves(k, radii(pair.radius_a), radii(pair.radius_b));
    const auto [radius_a, radius_b] = serves ? std::pair(pair.radius_a, pair.radius_b) : contact.choice.radii_of(k, {}, {});
    PairLaw law = resolve_pair(*contact.law, a, b, "granulaw_contact", radius_a, radius_b);
    if (pair.no_waves) law.radiation = 0;
    const Tabulated normal(law, law.measure(), scale);
    ContactElement<Tabulated, Tangential, Beside> element{normal};
    if constexpr (std::same_as<Beside, DentAdhesion>) {
      element.beside = DentAdhesion(normal, pair.work_of_adhesion, said(pair.adhesion_range, usual_adhesion_range / scale.length));
      if (const double r_eff = serves ? r_eff_of(radius_a, radius_b) : 0; r_eff > 0 && std::isfinite(r_eff))
        if (const std::string why = element.beside.fault(normal, r_eff); !why.empty()) fail("granulaw_contact", why);
    }
    if constexpr (std::same_as<Tangential, Spring>) element.tangential = Spring(spring);
    if constexpr (std::same_as<Tangential, PlasticShear>) {
      if (const std::string why = unknown_flow_stress(*contact.law, law); !why.empty()) fail("granulaw_contact", why);
      element.tangential = PlasticShear(normal, spring, bodies);
    }
    element.damping = elastic_dashpot(pair.elastic_damping, normal.pair_modulus(), scale.stretch);
    element.yield_overlap = normal.yield_overlap();
    laws.push_back({law, element, normal.largest_overlap()});
  }
  contact.laws = std::move(laws);
}

void make_laws(granulaw_contact_law& contact, const granulaw_pair& pair)
{
  if (pair.work_of_adhesion > 0 && pair.friction == 0.0)
    make_laws<Frictionless, DentAdhesion>(contact, pair);
  else if (pair.work_of_adhesion > 0)
    make_laws<Spring, DentAdhesion>(contact, pair);
  else if (pair.yields_in_shear)
    make_laws<PlasticShear>(contact, pair);
  else if (pair.friction == 0.0)
    make_laws<Frictionless>(contact, pair);
  else
    make_laws<Spring>(contact, pair);
}

/// m.
template <class Element>
double reach_of(const Element& element, double r_eff)
{
  if constexpr (Element::has_beside) return element.beside.reach(r_eff);
  return 0.0;
}

/// The law for bodies of these radii, one of which may be infinite.
template <class Laws>
const auto& sized(const granulaw_contact_law& contact, const Laws& laws, double radius_a, double radius_b)
{
  return laws[contact.finder.nearest(std::min(radius_a, wall_radius), std::min(radius_b, wall_radius))];
}

/// False of radii and m* that no two bodies have.
bool are_bodies(double radius_a, double radius_b, double r_eff, double m_eff)
{
  return (radius_a > 0) & (radius_b > 0) & std::isfinite(r_eff) & (m_eff > 0) & std::isfinite(m_eff);
}
bool are_bodies(double radius_a, double radius_b, double m_eff)
{
  return are_bodies(radius_a, radius_b, r_eff_of(radius_a, radius_b), m_eff);
}

/// Called for each contact and step: one branch.
[[gnu::always_inline]] inline bool has_numbers(const granulaw_motion& m, double r_eff)
{
  const double normal = (m.normal[0] + m.normal[1]) + m.normal[2], slide = (m.slide[0] + m.slide[1]) + m.slide[2],
               rolling = (m.rolling[0] + m.rolling[1]) + m.rolling[2], rest = (m.overlap + m.approach) + m.dt;
  return std::isfinite((normal + slide) + (rolling + rest)) & are_bodies(m.radius_a, m.radius_b, r_eff, m.m_eff);
}

ContactMotion motion_of(const granulaw_motion& m, double r_eff)
{
  return {{r_eff, m.overlap, m.approach, !m.asked_again},
          m.m_eff,
          m.dt,
          {m.normal[0], m.normal[1], m.normal[2]},
          {m.slide[0], m.slide[1], m.slide[2]},
          {m.rolling[0], m.rolling[1], m.rolling[2]}};
}

/// The caller's part in a step: forces alone, and the stiffness where waves go by it.
struct Forces : NoCaller
{
  bool waves;
  bool with_stiffness() const { return waves; }
};

/// Bits of granulaw_answer::beyond of a contact with these values before the step.
template <class Element>
unsigned beyond(const granulaw_contact_law& contact, const SizedLaw<Element>& one, const granulaw_motion& m,
                const ContactMotion& moves, bool begins)
{
  const Tabulated& normal = one.element.normal;
  unsigned bits = moves.overlap > one.largest_overlap * moves.r_eff ? unsigned{GRANULAW_BEYOND_OVERLAP} : 0u;
  if (!begins || !normal.needs_mass()) return bits;
  if (m.approach > normal.max_speed(moves.r_eff, m.m_eff)) bits |= GRANULAW_BEYOND_FAST;
  if (m.approach < normal.min_speed(moves.r_eff, m.m_eff)) bits |= GRANULAW_BEYOND_SLOW;
  if (const double only = one.law.only_radius(); only > 0) {
    const bool is_a = one.law.yielding->material.name == contact.names.first;
    const double radius = (is_a ? m.radius_a : m.radius_b) * contact.scale.length;
    if (!(std::abs(radius / only - 1) <= size_tolerance)) bits |= GRANULAW_BEYOND_SIZE;
  }
  return bits;
}

template <class Laws>
std::size_t advance(const granulaw_contact_law& contact, const Laws& laws, std::size_t n, const granulaw_motion* motion,
                    double* history, granulaw_answer* answers, Ledger& ledger)
{
  using Element = decltype(laws[0].element);
  for (std::size_t k = 0; k < n; ++k, history += Element::values) {
    const granulaw_motion& m = at(motion, k);
    granulaw_answer& now = at(answers, k);
    if (m.overlap <= 0 && (!Element::has_beside || !has_numbers(m, r_eff_of(m.radius_a, m.radius_b)))) {
      if (!m.asked_again) std::fill_n(history, Element::values, 0.0);
      now = {answers->size, 0.0, {}, {}, 0u};
      continue;
    }
    const double r_eff = r_eff_of(m.radius_a, m.radius_b);
    if (!has_numbers(m, r_eff)) [[unlikely]]
      return k;
    const auto& one = sized(contact, laws, m.radius_a, m.radius_b);
    const ContactMotion moves = motion_of(m, r_eff);
    const bool begins = Element::State::largest(history) == 0.0;
    Forces caller;
    caller.waves = one.element.normal.radiation > 0;
    const ContactForce force = Element::has_beside && m.overlap <= 0 ? one.element.advance(moves, history, ledger)
                                                                      : one.element.touch(moves, history, ledger, caller);
    now.normal = force.normal;
    // component by component: a copy of the whole would wait in memory for its parts
    now.shear[0] = force.shear[0], now.shear[1] = force.shear[1], now.shear[2] = force.shear[2];
    now.couple[0] = force.couple[0], now.couple[1] = force.couple[1], now.couple[2] = force.couple[2];
    now.beyond = beyond(contact, one, m, moves, begins);
  }
  return n;
}

template <class Laws>
std::size_t states(const granulaw_contact_law& contact, const Laws& laws, std::size_t n, const granulaw_motion* motion,
                   const double* history, granulaw_state* states)
{
  using Element = decltype(laws[0].element);
  using State = typename Element::State;
  for (std::size_t k = 0; k < n; ++k, history += Element::values) {
    const granulaw_motion& m = at(motion, k);
    granulaw_state& now = at(states, k);
    now = {states->size, 0.0, 0.0, 0.0, State::largest(history), GRANULAW_APART};
    if (m.overlap <= 0 && !Element::has_beside) continue;
    const double r_eff = r_eff_of(m.radius_a, m.radius_b);
    if (!has_numbers(m, r_eff)) return k;
    const auto& element = sized(contact, laws, m.radius_a, m.radius_b).element;
    const Tabulated& normal = element.normal;
    const ContactMotion moves = motion_of(m, r_eff);
    if constexpr (Element::has_beside)
      now.stored_energy = element.beside.stored_energy(normal, moves.r_eff, m.overlap, history, history + Element::beside_at);
    if (m.overlap <= 0) continue;
    double own[State::values];
    std::copy_n(history, State::values, own);
    const double largest = State::largest(history), impact_overlap = State::impact_overlap(history);
    const double deepest = std::max(largest, m.overlap);
    const Response response = normal.response(moves.r_eff, m.overlap, largest, impact_overlap, own + State::own);
    now.stiffness = response.stiffness;
    now.contact_radius = element.contact_radius(moves, history);
    now.stored_energy += normal.stored_energy(moves.r_eff, m.overlap, deepest, impact_overlap);
    now.largest_overlap = deepest;
    const double per_length = normal.per_lambda / moves.r_eff;
    if (!normal.curve->unloads(m.overlap * per_length, deepest * per_length))
      now.branch = GRANULAW_LOADING;
    else if (response.force > 0)
      now.branch = GRANULAW_UNLOADING;
  }
  return n;
}

/// What `visit` says of the history value that has this place; 0: there is none.
template <class Visit>
int of_value(const granulaw_contact_law* contact, std::size_t place, Visit&& visit)
{
  if (!contact) return 0;
  return std::visit(
      [&](const auto& laws) {
        std::size_t behind = 0;
        for (const HistoryValue& one : decltype(laws[0].element)::history_values)
          if (place < (behind += one.values)) return visit(one) ? 1 : 0;
        return 0;
      },
      contact->laws);
}

int open(granulaw_law** law, granulaw_why* why, auto&& read)
{
  static std::mutex one_at_a_time;  // HDF5 may be built for one thread
  const std::lock_guard lock(one_at_a_time);
  return guarded(GRANULAW_NO_FILE, why, [&] {
    *law = law_handle(std::make_shared<const Law>(read()));
  });
}

}  // namespace

granulaw_law* granulaw::law_handle(std::shared_ptr<const Law> law)
{
  auto opened = std::make_unique<granulaw_law>();
  for (const auto& [name, body] : law->bodies) opened->materials.push_back(&body.material);
  opened->law = std::move(law);
  return opened.release();
}

unsigned granulaw_abi(void)
{
  return GRANULAW_ABI;
}

const char* granulaw_version(void)
{
  return version();
}

int granulaw_open(const char* path, granulaw_law** law, granulaw_why* why)
{
  if (law) *law = nullptr;
  if (!path || !law) return failed(GRANULAW_NO_POINTER, why, "granulaw_open: path or law is null");
  return open(law, why, [&] { return read_law(path); });
}

int granulaw_open_image(const void* bytes, size_t count, const char* name, granulaw_law** law, granulaw_why* why)
{
  if (law) *law = nullptr;
  if (!bytes || !name || !law) return failed(GRANULAW_NO_POINTER, why, "granulaw_open_image: bytes, name or law is null");
  return open(law, why, [&] { return read_law_image({static_cast<const char*>(bytes), count}, name); });
}

void granulaw_close(granulaw_law* law)
{
  delete law;
}

size_t granulaw_materials(const granulaw_law* law)
{
  return law ? law->materials.size() : 0;
}

int granulaw_material_of(const granulaw_law* law, size_t place, granulaw_material* material)
{
  if (!law) return GRANULAW_NO_POINTER;
  if (place >= law->materials.size()) return GRANULAW_NO_NUMBER;
  const LawMaterial& m = *law->materials[place];
  return answer(material, {.size = 0,
                           .name = m.name.c_str(),
                           .density = m.density,
                           .youngs_modulus = m.youngs_modulus,
                           .poisson_ratio = m.poisson_ratio,
                           .yield_stress = m.yields() ? m.yield_stress : std::numeric_limits<double>::infinity()});
}

size_t granulaw_pairs(const granulaw_law* law)
{
  return law ? law->law->pairs.size() : 0;
}

int granulaw_pair_of(const granulaw_law* law, size_t place, const char** a, const char** b)
{
  if (!law || !a || !b) return GRANULAW_NO_POINTER;
  if (place >= law->law->pairs.size()) return GRANULAW_NO_NUMBER;
  *a = law->law->pairs[place].a.c_str(), *b = law->law->pairs[place].b.c_str();
  return GRANULAW_OK;
}

void granulaw_usual_pair(granulaw_pair* pair, size_t size)
{
  if (!pair) return;
  std::memset(pair, 0, size);
  if (size < first_size<granulaw_pair>) return;  // granulaw_contact() says so
  pair->size = size;
  pair->shear_damping = usual_shear_damping, pair->elastic_damping = usual_elastic_damping;
}

int granulaw_contact(const granulaw_law* law, const granulaw_pair* given, granulaw_contact_law** contact,
                     granulaw_why* why)
{
  if (contact) *contact = nullptr;
  if (!law || !given || !contact) return failed(GRANULAW_NO_POINTER, why, "granulaw_contact: law, pair or contact is null");
  if (!is_known(given, why, "granulaw_pair")) return GRANULAW_NO_SIZE;
  granulaw_pair whole{};  // 0 where an older program has no member
  std::memcpy(&whole, given, std::min(given->size, sizeof whole));
  const granulaw_pair* pair = &whole;
  if (!pair->a || !pair->b) return failed(GRANULAW_NO_POINTER, why, "granulaw_contact: a name of the pair is null");
  if (const char* wrong = wrong_number(*pair))
    return failed(GRANULAW_NO_NUMBER, why, std::string("granulaw_contact: ") + wrong);
  if (std::string(pair->a) == wall_name) return failed(GRANULAW_NO_LAW, why, "granulaw_contact: the wall is b");
  return guarded(GRANULAW_NO_LAW, why, [&] {
    (void)resolve_pair(*law->law, pair->a, pair->b, "granulaw_contact");
    std::unique_ptr<granulaw_contact_law> made(new granulaw_contact_law{
        law->law,
        {pair->a, pair->b},
        {said(pair->length, 1.0), said(pair->mass, 1.0), said(pair->stretch, 1.0), said(pair->time, 1.0)},
        size_choice(*law->law, pair->a, pair->b),
        {},
        {}});
    made->finder = made->choice.finder(made->choice.usual(radii(pair->radius_a), radii(pair->radius_b)));
    make_laws(*made, *pair);
    *contact = made.release();
  });
}

void granulaw_close_contact(granulaw_contact_law* contact)
{
  delete contact;
}

size_t granulaw_history(const granulaw_contact_law* contact)
{
  if (!contact) return 0;
  return std::visit([](const auto& laws) { return decltype(laws[0].element)::values; }, contact->laws);
}

int granulaw_changes_sign(const granulaw_contact_law* contact, size_t place)
{
  return of_value(contact, place, [](const HistoryValue& one) { return one.changes_sign; });
}

int granulaw_is_derived(const granulaw_contact_law* contact, size_t place)
{
  return of_value(contact, place, [](const HistoryValue& one) { return one.derived; });
}

int granulaw_range_of(const granulaw_contact_law* contact, double radius_a, double radius_b, double m_eff,
                      granulaw_range* range)
{
  if (!contact) return GRANULAW_NO_POINTER;
  if (!are_bodies(radius_a, radius_b, m_eff)) return GRANULAW_NO_NUMBER;
  return std::visit(
      [&](const auto& laws) {
        const Tabulated& normal = sized(*contact, laws, radius_a, radius_b).element.normal;
        const double r_eff = r_eff_of(radius_a, radius_b);
        return answer(range, {.size = 0,
                              .overlap = normal.largest_overlap(),
                              .yield_overlap = normal.yield_overlap(),
                              .slowest = normal.min_speed(r_eff, m_eff),
                              .fastest = normal.max_speed(r_eff, m_eff),
                              .reach = reach_of(sized(*contact, laws, radius_a, radius_b).element, r_eff) / r_eff});
      },
      contact->laws);
}

int granulaw_bound_of(const granulaw_contact_law* contact, double radius_a, double radius_b, double m_eff, double speed,
                      granulaw_bound* bound)
{
  if (!contact) return GRANULAW_NO_POINTER;
  if (!are_bodies(radius_a, radius_b, m_eff) || !(speed > 0)) return GRANULAW_NO_NUMBER;
  const auto& [length, mass, stretch, time] = contact->scale;
  ChosenPair pair{contact->names, radius_a * length, radius_b * length, {}, r_eff_of(radius_a, radius_b) * length, m_eff * mass};
  pair.law = std::visit([&](const auto& laws) { return sized(*contact, laws, radius_a, radius_b).law; }, contact->laws);
  const ErrorBound found = bound_of_impact(*contact->law, pair, speed * length / time);
  if (!found.stated()) {
    constexpr double none = std::numeric_limits<double>::infinity();
    return answer(bound, {.size = 0, .force = none, .restitution = none, .relative_restitution = none});
  }
  return answer(bound, {.size = 0,
                        .force = found.force,
                        .restitution = found.restitution,
                        .relative_restitution = found.relative_restitution + found.axis_restitution});
}

int granulaw_advance(const granulaw_contact_law* contact, size_t n, const granulaw_motion* motion, double* history,
                     granulaw_answer* answers, double* ledger, size_t* done)
{
  if (done) *done = 0;
  if (n == 0) return GRANULAW_OK;
  if (!contact || !motion || !history || !answers) return GRANULAW_NO_POINTER;
  if (!is_known(motion, nullptr, "") || answers->size < sizeof(granulaw_answer)) return GRANULAW_NO_SIZE;
  Ledger none;
  static_assert(sizeof(Ledger) == GRANULAW_MECHANISMS * sizeof(double) && std::is_standard_layout_v<Ledger>);
  Ledger& taken = ledger ? *reinterpret_cast<Ledger*>(ledger) : none;  // no copy: its sum would wait in memory for the parts
  const std::size_t advanced = std::visit(
      [&](const auto& laws) { return advance(*contact, laws, n, motion, history, answers, taken); }, contact->laws);
  if (done) *done = advanced;
  return advanced == n ? GRANULAW_OK : GRANULAW_NO_NUMBER;
}

int granulaw_state_of(const granulaw_contact_law* contact, size_t n, const granulaw_motion* motion,
                      const double* history, granulaw_state* state)
{
  if (n == 0) return GRANULAW_OK;
  if (!contact || !motion || !history || !state) return GRANULAW_NO_POINTER;
  if (!is_known(motion, nullptr, "") || state->size < sizeof(granulaw_state)) return GRANULAW_NO_SIZE;
  const std::size_t done =
      std::visit([&](const auto& laws) { return states(*contact, laws, n, motion, history, state); }, contact->laws);
  return done == n ? GRANULAW_OK : GRANULAW_NO_NUMBER;
}
