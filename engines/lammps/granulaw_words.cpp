#include "granulaw_words.hpp"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>

#include "comm.h"
#include "fix.h"
#include "force.h"
#include "lammps.h"
#include "modify.h"
#include "update.h"
#include "utils.h"

namespace granulaw::lammps {

LawFile LawFile::read(LAMMPS* lmp, const std::string& path)
{
  std::string bytes;
  int count = -1;
  if (lmp->comm->me == 0)
    if (std::ifstream file(path, std::ios::binary); file) {
      bytes.assign(std::istreambuf_iterator<char>(file), {});
      count = static_cast<int>(bytes.size());
    }
  MPI_Bcast(&count, 1, MPI_INT, 0, lmp->world);
  if (count < 0) stop_all(lmp, fmt::format("granulaw: cannot open the law file '{}'", path));
  bytes.resize(static_cast<std::size_t>(count));
  MPI_Bcast(bytes.data(), count, MPI_CHAR, 0, lmp->world);
  granulaw_law* law = nullptr;
  granulaw_why why;
  if (granulaw_open_image(bytes.data(), bytes.size(), path.c_str(), &law, &why)) stop_all(lmp, fmt::format("granulaw: {}", why.text));
  return {path, {law, Close{}}};
}

granulaw_material LawFile::material(LAMMPS* lmp, const std::string& name) const
{
  granulaw_material found{};
  found.size = sizeof found;
  std::string names;
  for (std::size_t k = 0; k < granulaw_materials(law.get()); ++k) {
    granulaw_material_of(law.get(), k, &found);
    if (name == found.name) return found;
    names += fmt::format(" {}", found.name);
  }
  stop_all(lmp, fmt::format("granulaw: no material '{}' in {}; it has:{}", name, path, names));
}

Words Words::usual(LAMMPS* lmp)
{
  struct Units
  {
    double length, mass, time;
  };
  static const std::map<std::string, Units> known = {
      {"si", {1, 1, 1}}, {"cgs", {1e-2, 1e-3, 1}}, {"micro", {1e-6, 1e-15, 1e-6}}, {"nano", {1e-9, 1e-21, 1e-9}}};
  const auto found = known.find(lmp->update->unit_style);
  if (found == known.end()) stop_all(lmp, fmt::format("granulaw: units are si, cgs, micro or nano, found '{}'", lmp->update->unit_style));
  Words words;
  granulaw_usual_pair(&words.pair, sizeof words.pair);
  words.pair.length = found->second.length, words.pair.mass = found->second.mass, words.pair.time = found->second.time;
  return words;
}

int Words::read(LAMMPS* lmp, int k, int narg, char** arg, const std::string& where)
{
  const std::map<std::string, double*> numbers = {{"friction", &pair.friction},         {"damping", &pair.shear_damping}, {"elastic_damping", &pair.elastic_damping},
                                                  {"shear_stiffness", &pair.shear_stiffness}, {"stretch", &pair.stretch},       {"rolling", &rolling}};
  struct Choice
  {
    const char *off, *on;
    int* value;
  };
  int stops = stops_beyond, waves = !pair.no_waves;
  const std::map<std::string, Choice> choices = {
      {"tangential", {"history", "plastic", &pair.yields_in_shear}}, {"beyond", {"continue", "stop", &stops}}, {"waves", {"off", "on", &waves}}};
  for (; k < narg; k += 2) {
    const auto number = numbers.find(arg[k]);
    const auto choice = choices.find(arg[k]);
    if (number == numbers.end() && choice == choices.end()) break;
    if (k + 1 >= narg) stop_all(lmp, fmt::format("{}: a value is missing behind '{}'", where, arg[k]));
    const std::string value = arg[k + 1];
    if (number != numbers.end()) {
      *number->second = LAMMPS_NS::utils::numeric(FLERR, arg[k + 1], false, lmp);
      if (!(*number->second >= 0.0)) stop_all(lmp, fmt::format("{}: {} is {}; it is 0 or more", where, arg[k], value));
      continue;
    }
    const auto& [off, on, place] = choice->second;
    if (value != off && value != on) stop_all(lmp, fmt::format("{}: {} is '{}'; it is {} or {}", where, arg[k], value, off, on));
    *place = value == on;
  }
  stops_beyond = stops, pair.no_waves = !waves;
  return k;
}

ContactLaw Words::contact(LAMMPS* lmp, const LawFile& file, const std::string& a, const std::string& b, double radius_a, double radius_b) const
{
  granulaw_pair of = pair;
  of.a = a.c_str(), of.b = b.c_str();
  if (radius_a > 0 && radius_b > 0) of.radius_a = radius_a, of.radius_b = radius_b;
  granulaw_contact_law* made = nullptr;
  granulaw_why why;
  if (granulaw_contact(file.law.get(), &of, &made, &why)) stop_all(lmp, fmt::format("granulaw: {} against {}: {}", a, b, why.text));
  ContactLaw contact;
  contact.law.reset(made);
  contact.values = static_cast<int>(granulaw_history(made)) + (rolling > 0 ? 3 : 0);
  contact.rolling = rolling, contact.stops_beyond = stops_beyond;
  const auto compliance = [&](const std::string& name) {
    if (name == "wall") return 0.0;
    const granulaw_material m = file.material(lmp, name);
    return 2.0 * (2.0 - m.poisson_ratio) * (1.0 + m.poisson_ratio) / m.youngs_modulus;
  };
  const double pressure = pair.mass / (pair.length * pair.time * pair.time);
  contact.shear = pair.shear_stiffness > 0 ? pair.shear_stiffness : 8.0 / (compliance(a) + compliance(b)) / pressure;
  if (pair.stretch > 1) contact.shear *= std::pow(pair.stretch, -2.5);
  return contact;
}

void Books::range(LAMMPS* lmp, double* book, const ContactLaw& law, const granulaw_motion& m, const granulaw_answer& now, LAMMPS_NS::tagint atom)
{
  for (int k = 0; k < 4; ++k) book[GRANULAW_MECHANISMS + k] += !m.asked_again && (now.beyond & (1u << k)) ? 1.0 : 0.0;
  if (now.beyond & GRANULAW_BEYOND_SIZE)
    stop_one(lmp, fmt::format("granulaw: a contact of atom {}: the file has no rate-dependent law for a particle of radius {:.6g}", atom, m.radius_a));
  if (!law.stops_beyond || !(now.beyond & GRANULAW_BEYOND_OVERLAP)) return;
  granulaw_range range{};
  range.size = sizeof range;
  granulaw_range_of(law.law.get(), m.radius_a, m.radius_b, m.m_eff, &range);
  const double overlap = m.overlap * (1.0 / m.radius_a + 1.0 / m.radius_b);
  if (overlap > 1.05 * range.overlap)
    stop_one(lmp, fmt::format("granulaw: overlap/R* {:.4g} of a contact of atom {} is more than 5 % beyond the law's table, which ends at {:.4g}: build a "
                              "deeper law by 'mpm table', or say 'beyond continue'", overlap, atom, range.overlap));
}

std::array<double, Books::size> Books::sums(MPI_Comm world) const
{
  std::array<double, size> all;
  for (int k = 0; k < size; ++k) all[k] = total(k);
  MPI_Allreduce(MPI_IN_PLACE, all.data(), size, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

void Books::write(LAMMPS* lmp, FILE* file) const
{
  const std::array<double, size> all = sums(lmp->world);
  if (lmp->comm->me != 0) return;
  const int bytes = sizeof all;
  fwrite(&bytes, sizeof bytes, 1, file);
  fwrite(all.data(), sizeof all, 1, file);
}

void Books::read(LAMMPS* lmp, const char* buffer, std::array<double, 4>& before)
{
  *this = {};
  const auto* all = reinterpret_cast<const double*>(buffer);
  if (lmp->comm->me == 0) std::copy_n(all, size, own.begin());
  std::copy_n(all + GRANULAW_MECHANISMS, 4, before.begin());
}

void Books::warn(LAMMPS* lmp, const Books& books, std::array<double, 4>& before, const char* where)
{
  static constexpr const char* what[] = {"contact steps deeper than the law's table", "contacts began faster than the law's velocity axis goes",
                                         "contacts began slower than the law's rate axis begins", "contacts of a size that the file has no law for"};
  const std::array<double, size> sums = books.sums(lmp->world);
  for (int k = 0; k < 4; ++k) {
    const double all = sums[GRANULAW_MECHANISMS + k];
    if (all > before[k] && lmp->comm->me == 0) lmp->error->warning(FLERR, fmt::format("{}: {:.6g} {}", where, all - before[k], what[k]));
    before[k] = all;
  }
}

void BodyMass::find(LAMMPS* lmp)
{
  lmp_ = lmp;
  rigid_.clear(), freeze_ = 0;
  for (int f = 0; f < lmp->modify->nfix; ++f) {
    LAMMPS_NS::Fix& fix = *lmp->modify->fix[f];
    if (fix.rigid_flag) rigid_.push_back(f);
    if (std::strcmp(fix.style, "freeze") == 0) freeze_ |= fix.groupbit;
  }
}

double BodyMass::inverse(const LAMMPS_NS::Atom& atom, int i) const
{
  if (atom.mask[i] & freeze_) return 0.0;
  for (const int f : rigid_) {
    int dim;
    const auto* body = static_cast<const int*>(lmp_->modify->fix[f]->extract("body", dim));
    const auto* mass = static_cast<const double*>(lmp_->modify->fix[f]->extract("masstotal", dim));
    if (body && mass && body[i] >= 0) return 1.0 / mass[body[i]];
  }
  return 1.0 / atom.rmass[i];
}

}  // namespace granulaw::lammps
