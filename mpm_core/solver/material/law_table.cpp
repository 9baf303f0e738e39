#include "solver/material/law_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <ranges>

#include "base/error.hpp"

namespace granulaw {

namespace {

template <class... Law>
std::vector<FlowLawKeys> keys_of(flow::LawList<Law...>)
{
  std::vector<FlowLawKeys> laws{{Law::name, {std::begin(Law::parameters), std::end(Law::parameters)}}...};
  if (laws.front().name == flow::RateIndependent::name) laws.erase(laws.begin());
  return laws;
}

/// Calls use(Law{}, place) for the law of that name; false if the list has none.
template <class Use, class... Law>
bool with_law(flow::LawList<Law...>, const std::string& name, Use use)
{
  int place = 0;
  bool found = false;
  ((name == Law::name ? (found = true, use(Law{}, place++)) : void(place++)), ...);
  return found;
}

/// Numbers that `from` reads, in units of `stress` and 1/`time`; a sentence if the law cannot be used.
template <class Law>
const char* pack(const FlowLaw& law, double stress, double time, double* out)
{
  std::vector<std::vector<double>> lists;
  for (const flow::Parameter& p : Law::parameters) {
    std::vector<double> list = law.values.at(p.key);
    for (double& value : list) {
      if (p.quantity == flow::Quantity::stress) value /= stress;
      if (p.quantity == flow::Quantity::rate) value *= time;
      if (p.quantity == flow::Quantity::angle) value = std::sin(value * M_PI / 180);
    }
    lists.push_back(std::move(list));
  }
  if constexpr (flow::LawOfLists<Law>) {
    return Law::pack(lists[0].data(), static_cast<int>(lists[0].size()), lists[1].data(),
                     static_cast<int>(lists[1].size()), out);
  } else {
    for (std::size_t k = 0; k < lists.size(); ++k) out[k] = lists[k].front();
    return nullptr;
  }
}

/// Every key of the law is there, within its bounds, and no other.
template <class Law>
void check_values(const FlowLaw& law, const std::string& where)
{
  std::vector<std::string> keys;
  for (const flow::Parameter& p : Law::parameters) keys.push_back(p.key);
  for (const auto& [key, values] : law.values)
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      fail(where, fmt::format("the law '{}' has no '{}'{}", law.name, key, did_you_mean(key, keys)), {},
           fmt::format("{}", fmt::join(keys, ", ")));
  for (const flow::Parameter& p : Law::parameters) {
    const auto found = law.values.find(p.key);
    if (found == law.values.end() || found->second.empty())
      fail(where, fmt::format("the law '{}' needs '{}'", law.name, p.key));
    if (!p.list && found->second.size() != 1) fail(where, fmt::format("'{}' must be one number", p.key));
    for (const double value : found->second)
      if (!(value >= p.least && value <= p.most))
        fail(where, fmt::format("'{}' of the law '{}' is out of range", p.key, law.name),
             fmt::format("{:g}", value),
             p.most >= flow::no_limit ? (p.least > 0 ? "over 0" : "0 or more")
                                      : fmt::format("{:g} to {:g}", p.least, p.most));
  }
}

FlowLaw hardening_of(const Material& m)
{
  if (!m.hardening.name.empty()) return m.hardening;
  return {flow::Linear::name, {{"modulus", {m.hardening_modulus}}}};
}

template <class List>
void check_name(List list, const std::vector<FlowLawKeys>& known, const FlowLaw& law, const char* kind,
                const std::string& where)
{
  if (with_law(list, law.name, [&](auto chosen, int) {
        if constexpr (!std::is_same_v<decltype(chosen), flow::RateIndependent>)
          check_values<decltype(chosen)>(law, where);
      }))
    return;
  std::vector<std::string> names;
  for (const FlowLawKeys& k : known) names.push_back(k.name);
  fail(where, fmt::format("no {} '{}'{}", kind, law.name, did_you_mean(law.name, names)), {},
       fmt::format("{}", fmt::join(names, ", ")));
}

}  // namespace

const std::vector<FlowLawKeys>& yield_surfaces()
{
  static const std::vector<FlowLawKeys> surfaces = keys_of(flow::YieldSurfaces{});
  return surfaces;
}

const std::vector<FlowLawKeys>& hardening_laws()
{
  static const std::vector<FlowLawKeys> laws = keys_of(flow::HardeningLaws{});
  return laws;
}

const std::vector<FlowLawKeys>& rate_laws()
{
  static const std::vector<FlowLawKeys> laws = keys_of(flow::RateLaws{});
  return laws;
}

void validate_flow(const Material& m, const std::string& where)
{
  const bool named = !m.hardening.name.empty();
  if (!m.yields() && (named || m.rate_dependent() || !m.yield_surface.name.empty()))
    fail(where, "'yield_surface', 'hardening' and 'rate' need a 'yield_stress'");
  if (!m.yield_surface.name.empty())
    check_name(flow::YieldSurfaces{}, yield_surfaces(), m.yield_surface, "yield surface", where);
  with_law(flow::YieldSurfaces{}, m.yield_surface.name, [&](auto chosen, int) {
    using Surface = decltype(chosen);
    double values[flow::surface_room];
    pack<Surface>(m.yield_surface, 1, 1, values);
    if constexpr (requires { Surface::misuse(values); })
      if (const char* problem = Surface::misuse(values))
        fail(where, fmt::format("yield surface '{}': {}", Surface::name, problem));
  });
  if (m.rate_dependent()) check_name(flow::RateLaws{}, rate_laws(), m.rate, "rate law", where);
  if (!named) return;
  check_name(flow::HardeningLaws{}, hardening_laws(), m.hardening, "hardening law", where);
  with_law(flow::HardeningLaws{}, m.hardening.name, [&](auto chosen, int) {
    using Law = decltype(chosen);
    double values[flow::law_room];
    const char* problem = pack<Law>(m.hardening, 1, 1, values);
    if constexpr (requires { Law::misuse(1.0, values); })
      if (!problem) problem = Law::misuse(m.yield_stress, values);
    if (problem) fail(where, fmt::format("hardening law '{}': {}", Law::name, problem));
    const double start = Law::from(m.yield_stress, values)(0.0).value;
    if (!(std::abs(start / m.yield_stress - 1) <= 1e-3))
      fail(where,
           fmt::format("the hardening law '{}' starts at {:.6g} Pa, which must be 'yield_stress' to 0.1 %",
                       Law::name, start),
           fmt::format("yield_stress = {:.6g} Pa", m.yield_stress));
  });
}

flow::Flow flow_of(const Material& m, double stress, double time)
{
  flow::Flow result;
  if (!m.yields()) return result;
  with_law(flow::YieldSurfaces{}, m.yield_surface.name, [&](auto chosen, int place) {
    result.surface = place;
    pack<decltype(chosen)>(m.yield_surface, stress, time, result.surface_values);
  });
  const FlowLaw hardening = hardening_of(m);
  with_law(flow::HardeningLaws{}, hardening.name, [&](auto chosen, int place) {
    result.hardening = place;
    pack<decltype(chosen)>(hardening, stress, time, result.hardening_values);
  });
  if (m.rate_dependent())
    with_law(flow::RateLaws{}, m.rate.name, [&](auto chosen, int place) {
      result.rate = place;
      if constexpr (!std::is_same_v<decltype(chosen), flow::RateIndependent>)
        pack<decltype(chosen)>(m.rate, stress, time, result.rate_values);
    });
  return result;
}

bool dilates(const Material& m)
{
  const flow::Flow laws = flow_of(m, 1, 1);
  bool found = false;
  with_law(flow::YieldSurfaces{}, m.yield_surface.name,
           [&](auto chosen, int) { found = decltype(chosen)::from(laws.surface_values).dilates(); });
  return found;
}

double flow_stress(const Material& m, double ep)
{
  const flow::Flow laws = flow_of(m, 1, 1);
  double stress = 0;
  with_law(flow::HardeningLaws{}, hardening_of(m).name, [&](auto chosen, int) {
    stress = decltype(chosen)::from(m.yield_stress, laws.hardening_values)(ep).value;
  });
  return stress;
}

Material with_strains_scaled(Material m, double by)
{
  m.hardening_modulus /= by;
  with_law(flow::HardeningLaws{}, m.hardening.name, [&](auto chosen, int) {
    using Law = decltype(chosen);
    if constexpr (flow::LawOfNumbers<Law>) {
      std::vector<double> values;
      for (const flow::Parameter& p : Law::parameters) values.push_back(m.hardening.values.at(p.key).front());
      Law::scale_strains(values.data(), by);
      for (std::size_t k = 0; k < values.size(); ++k)
        m.hardening.values.at(Law::parameters[k].key) = {values[k]};
    } else {
      for (const flow::Parameter& p : Law::parameters)
        if (p.quantity == flow::Quantity::number)
          for (double& strain : m.hardening.values.at(p.key)) strain *= by;
    }
  });
  return m;
}

double rate_factor(const Material& m, double rate)
{
  const flow::Flow laws = flow_of(m, 1, 1);
  double factor = 1;
  if (m.rate_dependent())
    with_law(flow::RateLaws{}, m.rate.name,
             [&](auto chosen, int) { factor = decltype(chosen)::from(laws.rate_values)(rate).value; });
  return factor;
}

}  // namespace granulaw
