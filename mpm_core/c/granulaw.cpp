#include "c/granulaw.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <string>
#include <variant>

#include "base/error.hpp"
#include "contact/element.hpp"
#include "contact/plastic_shear.hpp"
#include "contact/tabulated.hpp"
#include "law/law_file.hpp"

using namespace granulaw;

struct granulaw_law
{
  std::shared_ptr<const Law> law;
};

struct granulaw_contact_law
{
  std::shared_ptr<const Law> law;  // its curve is the element's
  std::variant<ContactElement<Tabulated>, ContactElement<Tabulated, Spring>,
               ContactElement<Tabulated, PlasticShear>>
      element;
};

static_assert(GRANULAW_MECHANISMS == static_cast<int>(Mechanism::count));
static_assert(GRANULAW_PLASTIC == static_cast<int>(Mechanism::plastic) &&
              GRANULAW_WAVES == static_cast<int>(Mechanism::waves) &&
              GRANULAW_FRICTION == static_cast<int>(Mechanism::friction) &&
              GRANULAW_SHEAR == static_cast<int>(Mechanism::shear));

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

/// A number of granulaw_pair: 0 stands for `usual`.
double said(double value, double usual)
{
  return value == 0.0 ? usual : value;
}

const char* wrong_number(const granulaw_pair& pair)
{
  const auto positive = [](double value) { return value >= 0 && std::isfinite(value); };
  if (!(pair.radius_a >= 0 && pair.radius_b >= 0) || (pair.radius_a > 0) != (pair.radius_b > 0) ||
      (std::isinf(pair.radius_a) && std::isinf(pair.radius_b)))
    return "radius_a and radius_b: both over 0, one of them infinity for a deformable wall, or both 0";
  if (!positive(pair.length) || !positive(pair.mass)) return "length and mass: over 0, or 0 for SI";
  if (!(pair.stretch == 0 || (pair.stretch >= 1 && std::isfinite(pair.stretch))))
    return "stretch: 1 or more, or 0 for 1";
  if (!positive(pair.friction) || !positive(pair.shear_stiffness) || !positive(pair.shear_damping))
    return "friction, shear_stiffness and shear_damping: 0 or more";
  return nullptr;
}

/// Moduli of the file's material of this name; a rigid wall is no material.
ElasticBody body_of(const Law& law, const std::string& name)
{
  if (name == wall_name) return {};
  const LawMaterial& material = law.bodies.at(name).material;
  return {material.youngs_modulus, material.poisson_ratio};
}

void make_element(granulaw_contact_law& contact, const granulaw_pair& pair)
{
  const Scale scale{said(pair.length, 1.0), said(pair.mass, 1.0), said(pair.stretch, 1.0)};
  const PairLaw law = resolve_pair(*contact.law, pair.a, pair.b, "granulaw_contact", said(pair.radius_a, 1.0),
                                   said(pair.radius_b, 1.0));
  const Tabulated normal(law, law.measure(), scale);
  BodiesInShear bodies = BodiesInShear::of(body_of(*contact.law, pair.a), body_of(*contact.law, pair.b), pair.shear_damping,
                                           scale.pressure());
  bodies.stiffness = said(pair.shear_stiffness, bodies.stiffness);
  const ShearPair spring = ShearPair::of(bodies.stiffness, pair.friction, pair.shear_damping, scale.stretch);
  if (pair.yields_in_shear) {
    if (const std::string why = unknown_flow_stress(*contact.law, law); !why.empty()) fail("granulaw_contact", why);
    contact.element = ContactElement<Tabulated, PlasticShear>{normal, PlasticShear(normal, spring, bodies)};
  } else if (pair.friction == 0.0)
    contact.element = ContactElement<Tabulated>{normal};
  else
    contact.element = ContactElement<Tabulated, Spring>{normal, Spring(spring)};
}

const Tabulated& normal_of(const granulaw_contact_law& contact)
{
  return std::visit([](const auto& element) -> const Tabulated& { return element.normal; }, contact.element);
}

bool has_numbers(const granulaw_motion& m)
{
  double sum = m.overlap + m.approach + m.dt;
  for (const double value : m.normal) sum += value;
  for (const double value : m.slide) sum += value;
  for (const double value : m.turn) sum += value;
  return std::isfinite(sum) && m.r_eff > 0 && m.m_eff > 0 && std::isfinite(m.r_eff) && std::isfinite(m.m_eff);
}

template <class Element>
int advance(const Element& element, std::size_t n, const granulaw_motion* motion, double* history,
            granulaw_answer* answer, Ledger& ledger)
{
  for (std::size_t k = 0; k < n; ++k, history += Element::values) {
    const granulaw_motion& m = motion[k];
    if (!has_numbers(m)) return GRANULAW_NO_NUMBER;
    const ContactMotion moves{{m.r_eff, m.overlap, m.approach, !m.asked_again},
                              m.m_eff,
                              m.dt,
                              {m.normal[0], m.normal[1], m.normal[2]},
                              {m.slide[0], m.slide[1], m.slide[2]},
                              {m.turn[0], m.turn[1], m.turn[2]}};
    const ContactForce force = element.advance(moves, history, ledger);
    answer[k] = {force.normal,
                 force.stiffness,
                 element.contact_radius(moves, history),
                 {force.shear[0], force.shear[1], force.shear[2]},
                 {force.couple[0], force.couple[1], force.couple[2]}};
  }
  return GRANULAW_OK;
}

}  // namespace

int granulaw_open(const char* path, granulaw_law** law, granulaw_why* why)
{
  if (law) *law = nullptr;
  if (!path || !law) return failed(GRANULAW_NO_POINTER, why, "granulaw_open: path or law is null");
  return guarded(GRANULAW_NO_FILE, why,
                 [&] { *law = new granulaw_law{std::make_shared<const Law>(read_law(path))}; });
}

void granulaw_close(granulaw_law* law)
{
  delete law;
}

int granulaw_contact(const granulaw_law* law, const granulaw_pair* pair, granulaw_contact_law** contact,
                     granulaw_why* why)
{
  if (contact) *contact = nullptr;
  if (!law || !pair || !contact || !pair->a || !pair->b)
    return failed(GRANULAW_NO_POINTER, why, "granulaw_contact: law, pair, a name of it or contact is null");
  if (const char* wrong = wrong_number(*pair))
    return failed(GRANULAW_NO_NUMBER, why, std::string("granulaw_contact: ") + wrong);
  return guarded(GRANULAW_NO_LAW, why, [&] {
    auto made = std::make_unique<granulaw_contact_law>();
    made->law = law->law;
    make_element(*made, *pair);
    *contact = made.release();
  });
}

void granulaw_close_contact(granulaw_contact_law* contact)
{
  delete contact;
}

size_t granulaw_kept(const granulaw_contact_law* contact)
{
  if (!contact) return 0;
  return std::visit([](const auto& element) { return element.values; }, contact->element);
}

int granulaw_turns(const granulaw_contact_law* contact, size_t place)
{
  if (!contact) return 0;
  return std::visit(
      [&](const auto& element) {
        std::size_t behind = 0;
        for (const HistoryValue& one : element.history_values)
          if (place < (behind += one.values)) return one.changes_sign ? 1 : 0;
        return 0;
      },
      contact->element);
}

granulaw_range granulaw_range_of(const granulaw_contact_law* contact, double r_eff, double m_eff)
{
  if (!contact) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return {none, none, none, none};
  }
  const Tabulated& normal = normal_of(*contact);
  return {normal.largest_overlap(), normal.yield_overlap(), normal.min_speed(r_eff, m_eff),
          normal.max_speed(r_eff, m_eff)};
}

int granulaw_advance(const granulaw_contact_law* contact, size_t n, const granulaw_motion* motion,
                     double* history, granulaw_answer* answer, double* ledger)
{
  if (n == 0) return GRANULAW_OK;
  if (!contact || !motion || !history || !answer) return GRANULAW_NO_POINTER;
  Ledger taken;
  const int code =
      std::visit([&](const auto& element) { return advance(element, n, motion, history, answer, taken); },
                 contact->element);
  for (std::size_t k = 0; ledger && k < taken.taken.size(); ++k) ledger[k] += taken.taken[k];
  return code;
}
