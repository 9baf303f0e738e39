// granulaw._granulaw: the libraries for Python. Types, units and errors are documented in granulaw/__init__.pyi.
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <ctime>
#include <limits>
#include <optional>

#include "base/error.hpp"
#include "base/version.hpp"
#include "body_impact.hpp"
#include "c/granulaw.h"
#include "c/law_handle.hpp"
#include "calibrate/calibrate.hpp"
#include "calibration_options.hpp"
#include "calibration_output.hpp"
#include "characterise/atlas_file.hpp"
#include "characterise/file/make_law_file.hpp"
#include "contact/damping.hpp"
#include "contact/tabulated.hpp"
#include "farm/farm.hpp"
#include "doc.hpp"
#include "law/law_file.hpp"
#include "law_report.hpp"
#include "material_file/materials_file.hpp"
#include "run_report.hpp"
#include "solver/runs.hpp"

namespace py = pybind11;
using namespace granulaw;

namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Kept = py::array_t<double, py::array::c_style>;
using SharedLaw = std::shared_ptr<const Law>;

py::object from_json(const nlohmann::ordered_json& json)
{
  return py::module_::import("json").attr("loads")(json.dump());
}

/// A callback of fractions, from any thread. Ctrl-C stops the run.
std::function<void(double)> reported_to(const std::function<void(double)>& progress)
{
  return [progress](double done) {
    const py::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (progress) progress(done);
  };
}

/// The parameter in place of the command's option at the head of a sentence: "--tangential-velocity: ..." is tangential_velocity.
std::string in_python(std::string sentence)
{
  if (!sentence.starts_with("--")) return sentence;
  std::replace(sentence.begin(), sentence.begin() + static_cast<std::ptrdiff_t>(std::min(sentence.find(':'), sentence.size())), '-', '_');
  return sentence.substr(2);
}

int threads_of(const char* name, int count)
{
  if (count < 1) fail(name, "cannot be used", std::to_string(count), "1 or more");
  return count;
}

/// An array that the call writes into; a copy would lose what is written.
Kept written_to(const char* name, const py::array& array)
{
  if (!Kept::check_(array)) fail(name, "is no float64 array in C order, as Contact.history() makes", std::string(py::str(array.dtype())));
  if (!array.writeable()) fail(name, "is read-only");
  return array;
}

// ---------------------------------------------------------------- materials and bodies

/// Materials of a file, or of the caller's dictionary.
Materials materials_of(const py::object& given)
{
  if (py::isinstance<Materials>(given)) return given.cast<Materials>();
  if (py::isinstance<py::dict>(given)) {
    Materials made;
    made.source = "materials";
    for (const auto& [key, value] : given.cast<py::dict>()) {
      const std::string name = py::str(key);
      if (!py::isinstance<Material>(value)) fail("materials", name + " is no granulaw.Material", std::string(py::str(py::type::of(value))));
      const auto material = value.cast<Material>();
      validate(material, name.c_str());
      made.materials[name] = material;
    }
    if (made.materials.empty()) fail("materials", "is empty");
    return made;
  }
  return read_materials(py::str(given));
}

Material material(double density, double youngs_modulus, double poisson_ratio, double yield_stress, double hardening_modulus)
{
  Material made{.density = density,
                .youngs_modulus = youngs_modulus,
                .poisson_ratio = poisson_ratio,
                .yield_stress = yield_stress,
                .hardening_modulus = hardening_modulus};
  validate(made, "Material");
  return made;
}

Partner partner_of(const py::object& against)
{
  Partner partner;
  if (against.is_none()) return partner;
  if (py::isinstance<Material>(against))
    partner.wall = against.cast<Material>();
  else if (!py::isinstance<Particle>(against))
    fail("against", "is neither a Particle nor a Material", std::string(py::str(py::type::of(against))));
  else
    partner.particle = against.cast<Particle>();
  return partner;
}

// ---------------------------------------------------------------- runs of the solver

struct RunChoice
{
  std::string grid = "auto";
  int resolution = 0, grids = 4, threads = 1;
  bool estimate_error = false;
  std::function<void(double)> progress;

  RunOptions options() const
  {
    RunOptions o;
    o.resolution = resolution, o.shifted_grids = grids, o.threads = threads_of("threads", threads), o.estimate_error = estimate_error;
    o.progress = reported_to(progress);
    o.grid = grid_of(grid);
    return o;
  }
};

/// The object of --json, and the trace as columns.
py::object answer_of(const Particle& particle, const RunChoice& choice, const RunResult& run, const CentreMotion& centre)
{
  const bool in_three_dimensions = run.rebound || !run.planes.empty();
  const std::string grid = in_three_dimensions ? name_of(GridKind::spatial) : choice.grid == "auto" ? name_of(choose_grid(particle).grid) : choice.grid;
  py::dict out = from_json(run_json(grid, run, centre));
  const auto column = [&](auto value) {
    py::array_t<double> numbers(static_cast<py::ssize_t>(run.trace.size()));
    for (std::size_t k = 0; k < run.trace.size(); ++k) numbers.mutable_at(k) = run.trace[k].*value;
    return numbers;
  };
  py::dict trace;
  trace["time_s"] = column(&TraceSample::time), trace["delta_m"] = column(&TraceSample::delta);
  trace["force_N"] = column(&TraceSample::force), trace["contact_radius_m"] = column(&TraceSample::contact_radius);
  out["trace"] = trace;
  return out;
}

// ---------------------------------------------------------------- laws

/// "a:b"; `what` leads the sentence of what is none.
PairNames names_in(const char* what, const std::string& pair)
{
  PairNames names = split_pair(pair);
  if (names.second.empty()) fail(what, "is no pair", pair, "'a:b' or 'a:wall'");
  return names;
}

/// Two bodies by name and size, with their law.
struct Pair
{
  SharedLaw law;
  ChosenPair chosen;
};

Pair pair_of(const SharedLaw& law, const std::string& pair, std::optional<double> radius, std::optional<double> radius2)
{
  return {law, choose_pair(*law, {"Law.pair", pair, radius, radius2})};
}

/// F, or F, K and a, at overlaps below largest overlaps of contacts that began at these speeds; arrays of one shape.
template <std::size_t count>
std::array<py::array_t<double>, count> evaluate(const Pair& p, const Numbers& overlap, const std::optional<Numbers>& largest, double speed)
{
  if (largest && largest->size() != 1 && largest->size() != overlap.size()) fail("largest", "has another length than overlap", std::to_string(largest->size()), fmt::format("1 or {}", overlap.size()));
  const PairLaw& law = p.chosen.law;
  std::array<py::array_t<double>, count> out;
  for (auto& one : out) one = py::array_t<double>(std::vector<py::ssize_t>(overlap.shape(), overlap.shape() + overlap.ndim()));
  std::array<double*, count> to{};
  for (std::size_t k = 0; k < count; ++k) to[k] = out[k].mutable_data();
  const double *d = overlap.data(), *m = largest ? largest->data() : d;
  const auto size = static_cast<std::size_t>(overlap.size()), step = std::size_t{!largest || largest->size() != 1};
  const py::gil_scoped_release release;
  const double latched = law.impact_overlap(p.chosen.r_eff, p.chosen.m_eff, speed);
  const Tabulated normal(law, law.measure(), Scale{});
  double own[NormalState<Tabulated>::values] = {};
  for (std::size_t q = 0; q < size; ++q) {
    const double deepest = std::max(m[q * step], d[q]);
    if (!std::isfinite(deepest)) fail("overlap", "is no number at place " + std::to_string(q));
    if (d[q] > p.chosen.limit() || deepest > p.chosen.limit())
      fail("overlap", "is beyond the law's table at place " + std::to_string(q), fmt::format("{:g} m", deepest), fmt::format("up to {:.4g} m", p.chosen.limit()));
    const bool touches = d[q] > 0;
    if constexpr (count == 1)
      to[0][q] = touches ? normal.force(p.chosen.r_eff, d[q], deepest, latched, own) : 0.0;
    else {
      const Response now = touches ? normal.response(p.chosen.r_eff, d[q], deepest, latched, own) : Response{};
      to[0][q] = now.force, to[1][q] = now.stiffness;
      to[2][q] = touches ? normal.contact_radius(p.chosen.r_eff, d[q], deepest, latched) : 0.0;
    }
  }
  return out;
}

py::object impact_by_law(const Pair& p, double velocity)
{
  std::optional<StatedCollision> found;
  const std::clock_t begun = std::clock();
  {
    const py::gil_scoped_release release;
    found = collide(*p.law, p.chosen, velocity, "Pair.impact");
  }
  py::dict out = from_json(law_json(*found, static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC));
  out["warnings"] = warnings_of(p.chosen, velocity, *found);
  return out;
}

py::array_t<double> restitution(const Pair& p, const Numbers& velocity)
{
  py::array_t<double> e(std::vector<py::ssize_t>(velocity.shape(), velocity.shape() + velocity.ndim()));
  double* out = e.mutable_data();
  const py::gil_scoped_release release;
  for (py::ssize_t k = 0; k < velocity.size(); ++k) out[k] = collide(*p.law, p.chosen, velocity.data()[k], "Pair.restitution").replay.restitution;
  return e;
}

SharedLaw table(const py::object& materials, const std::vector<std::string>& pairs, double tolerance, double depth, double damage_number, int jobs, const std::string& atlas_file,
    const std::function<void(double)>& progress)
{
  LawFileRequest request;
  request.materials = materials_of(materials);
  for (const std::string& pair : pairs) request.pairs.push_back(names_in("pairs", pair));
  request.tolerance = tolerance, request.depth = depth, request.damage_number = damage_number;
  const py::gil_scoped_release release;
  const Atlas atlas = read_atlas(atlas_file);
  request.atlas = &atlas;
  const LawFilePlan plan = plan_law_file(request);
  ThreadFarm farm(threads_of("jobs", jobs));
  const auto report = reported_to(progress);
  Law law = make_law_file(plan, &farm, [&](double done, const std::string&) { report(done); }).law;
  law.provenance["command"] = "granulaw.table";
  return std::make_shared<const Law>(std::move(law));
}

/// The words are those of `mpm calibrate`.
py::object calibrate_by(const std::vector<std::string>& words, const std::string& atlas_file)
{
  CLI::App app;
  app.set_help_flag();
  Options options(app);
  CalibrationOptions chosen;
  chosen.add_to(options, true);
  std::vector<std::string> reversed = split_lists(app, words);
  std::reverse(reversed.begin(), reversed.end());
  try {
    app.parse(reversed);
  } catch (const CLI::Error& wrong) {
    fail("calibrate", wrong.what());
  }
  std::optional<nlohmann::ordered_json> found;
  {
    const py::gil_scoped_release release;
    const Atlas atlas = read_atlas(atlas_file);
    const CalibrationProblem problem(atlas, chosen.request());
    if (!problem.request().known.hardens_linearly()) fail("calibrate", "a hardening law other than linear needs runs of the solver: `mpm calibrate` makes them");
    found = calibration_json(problem, calibrate(problem));
  }
  return from_json(*found);
}

// ---------------------------------------------------------------- contacts, by granulaw.h

struct ClosesLaw
{
  void operator()(granulaw_law* law) const { granulaw_close(law); }
};
struct ClosesContact
{
  void operator()(granulaw_contact_law* contact) const { granulaw_close_contact(contact); }
};

class Contact
{
 public:
  Contact(const SharedLaw& law, granulaw_pair pair, const std::string& names)
  {
    const auto [a, b] = names_in("Contact", names);
    pair.a = a.c_str(), pair.b = b.c_str();
    const std::unique_ptr<granulaw_law, ClosesLaw> handle(law_handle(law));
    granulaw_contact_law* made = nullptr;
    granulaw_why why;
    if (granulaw_contact(handle.get(), &pair, &made, &why) != GRANULAW_OK) throw Error(why.text);
    contact_.reset(made);
  }

  std::size_t values() const { return granulaw_history(contact_.get()); }
  py::array_t<double> history(py::ssize_t n) const
  {
    py::array_t<double> zeros({n, static_cast<py::ssize_t>(values())});
    std::fill_n(zeros.mutable_data(), zeros.size(), 0.0);
    return zeros;
  }
  static py::array_t<granulaw_motion> motion(py::ssize_t n)
  {
    granulaw_motion begins{};
    begins.size = sizeof begins, begins.radius_b = std::numeric_limits<double>::infinity(), begins.normal[2] = 1;
    return filled(n, begins);
  }

  py::array_t<granulaw_answer> advance(const py::array_t<granulaw_motion, py::array::c_style>& motion, const py::array& given, const std::optional<py::array>& given_ledger) const
  {
    Kept history = written_to("history", given);
    std::optional<Kept> ledger;
    if (given_ledger) ledger = written_to("ledger", *given_ledger);
    check(motion, history);
    if (ledger && ledger->size() != GRANULAW_MECHANISMS) fail("ledger", "has another length", std::to_string(ledger->size()), std::to_string(GRANULAW_MECHANISMS));
    granulaw_answer begins{};
    begins.size = sizeof begins;
    py::array_t<granulaw_answer> answers = filled(motion.size(), begins);
    const auto n = static_cast<std::size_t>(motion.size());
    double *kept = history.mutable_data(), *books = ledger ? ledger->mutable_data() : nullptr;
    granulaw_answer* out = answers.mutable_data();
    std::size_t done = 0;
    int code = 0;
    {
      const py::gil_scoped_release release;
      code = granulaw_advance(contact_.get(), n, motion.data(), kept, out, books, &done);
    }
    require(code, done);
    return answers;
  }
  py::array_t<granulaw_state> state(const py::array_t<granulaw_motion, py::array::c_style>& motion, const py::array_t<double, py::array::c_style>& history) const
  {
    check(motion, history);
    granulaw_state begins{};
    begins.size = sizeof begins;
    py::array_t<granulaw_state> states = filled(motion.size(), begins);
    require(granulaw_state_of(contact_.get(), static_cast<std::size_t>(motion.size()), motion.data(), history.data(), states.mutable_data()), 0);
    return states;
  }

 private:
  template <class Struct>
  static py::array_t<Struct> filled(py::ssize_t n, const Struct& with)
  {
    py::array_t<Struct> array(n);
    std::fill_n(array.mutable_data(), n, with);
    return array;
  }
  void check(const py::array_t<granulaw_motion, py::array::c_style>& motion, const py::array& history) const
  {
    if (history.size() != motion.size() * static_cast<py::ssize_t>(values()))
      fail("history", "has another size", std::to_string(history.size()), fmt::format("{} contacts x {} values", motion.size(), values()));
  }
  static void require(int code, std::size_t done)
  {
    if (code == GRANULAW_NO_NUMBER) fail("motion", fmt::format("contact {}: it has no number where it needs one", done));
    if (code == GRANULAW_NO_SIZE) fail("motion", "was not made by Contact.motion()");
  }

  std::unique_ptr<granulaw_contact_law, ClosesContact> contact_;
};

Contact contact(const SharedLaw& law, const std::string& pair, double friction, const std::string& tangential, double shear_stiffness, double shear_damping, double elastic_damping,
    double stretch, bool waves, double radius_a, double radius_b, double work_of_adhesion, double adhesion_range)
{
  if (tangential != "history" && tangential != "plastic") fail("tangential", "is no model", tangential, "history or plastic");
  granulaw_pair p;
  granulaw_usual_pair(&p, sizeof p);
  p.friction = friction, p.yields_in_shear = tangential == "plastic", p.shear_stiffness = shear_stiffness;
  p.shear_damping = shear_damping, p.elastic_damping = elastic_damping, p.stretch = stretch, p.no_waves = !waves;
  p.radius_a = radius_a, p.radius_b = radius_b, p.work_of_adhesion = work_of_adhesion, p.adhesion_range = adhesion_range;
  return {law, p, pair};
}

// ---------------------------------------------------------------- names with the docstrings of the stub

template <class... Described>
class Class
{
 public:
  Class(py::module_& m, const char* name) : class_(m, name, doc(name)), name_(name) {}
  Class& plain(auto&&... words) { return class_.def(std::forward<decltype(words)>(words)...), *this; }
  Class& method(const char* name, auto&&... words) { return class_.def(name, std::forward<decltype(words)>(words)..., of(name)), *this; }
  Class& static_method(const char* name, auto&&... words) { return class_.def_static(name, std::forward<decltype(words)>(words)..., of(name)), *this; }
  Class& property(const char* name, auto&& get) { return class_.def_property_readonly(name, std::forward<decltype(get)>(get), of(name)), *this; }
  Class& value(const char* name, auto&& member) { return class_.def_readonly(name, member, of(name)), *this; }

 private:
  const char* of(const char* name) const { return doc(name_ + "." + name); }
  py::class_<Described...> class_;
  std::string name_;
};

void function(py::module_& m, const char* name, auto&&... words) { m.def(name, std::forward<decltype(words)>(words)..., doc(name)); }

std::vector<std::string> pairs_of(const Law& law)
{
  std::vector<std::string> names;
  for (const LawPair& pair : law.pairs) names.push_back(pair.a + ":" + pair.b);
  return names;
}

std::map<std::string, Material> law_materials(const Law& law)
{
  std::map<std::string, Material> out;
  for (const auto& [name, body] : law.bodies) {
    const LawMaterial& m = body.material;
    out[name] = {.density = m.density, .youngs_modulus = m.youngs_modulus, .poisson_ratio = m.poisson_ratio, .yield_stress = m.yield_stress, .hardening_modulus = m.hardening_modulus};
  }
  return out;
}

}  // namespace

PYBIND11_MODULE(_granulaw, m)
{
  using py::arg;
  const auto none = py::none();
  PYBIND11_NUMPY_DTYPE(granulaw_motion, size, radius_a, radius_b, m_eff, overlap, approach, dt, normal, slide, rolling, asked_again);
  PYBIND11_NUMPY_DTYPE(granulaw_answer, size, normal, shear, couple, beyond);
  PYBIND11_NUMPY_DTYPE(granulaw_state, size, stiffness, contact_radius, stored_energy, largest_overlap, branch);
  static py::exception<Error> error(m, "Error", PyExc_ValueError);
  error.doc() = doc("Error");
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& wrong) {
      error(in_python(wrong.what()).c_str());
    }
  });
  m.attr("__version__") = version();

  Class<Material>(m, "Material")
      .plain(py::init(&material), py::kw_only(), arg("density"), arg("youngs_modulus"), arg("poisson_ratio"), arg("yield_stress") = std::numeric_limits<double>::infinity(),
          arg("hardening_modulus") = 0.0)
      .value("density", &Material::density)
      .value("youngs_modulus", &Material::youngs_modulus)
      .value("poisson_ratio", &Material::poisson_ratio)
      .value("yield_stress", &Material::yield_stress)
      .value("hardening_modulus", &Material::hardening_modulus)
      .plain("__repr__", [](const Material& o) {
        return fmt::format("Material(density={:g}, youngs_modulus={:g}, poisson_ratio={:g}, yield_stress={:g}, hardening_modulus={:g})", o.density, o.youngs_modulus,
            o.poisson_ratio, o.yield_stress, o.hardening_modulus);
      });
  Class<Particle>(m, "Particle").value("radius", &Particle::radius);
  Class<Materials>(m, "Materials")
      .value("materials", &Materials::materials)
      .property("particles", [](const Materials& o) { return names_of(o.particles); })
      .method("particle", &Materials::particle, arg("name"));
  function(m, "read_materials", [](const py::object& path) { return read_materials(py::str(path)); }, arg("path"));
  function(m, "sphere", [](double radius, const Material& material) {
             if (!(radius > 0 && std::isfinite(radius))) fail("radius", "cannot be used", fmt::format("{:g}", radius), "over 0 (m)");
             return Particle::sphere(radius, material);
           }, arg("radius"), arg("material"));

  Class<Law, std::shared_ptr<Law>>(m, "Law")
      .property("materials", &law_materials)
      .property("pairs", &pairs_of)
      .value("provenance", &Law::provenance)
      .method("write", [](const Law& law, const py::object& path) { write_law(law, py::str(path)); }, arg("path"))
      .method("pair", [](const std::shared_ptr<Law>& law, const std::string& pair, std::optional<double> radius, std::optional<double> radius2) { return pair_of(law, pair, radius, radius2); },
          arg("pair") = "", py::kw_only(), arg("radius") = none, arg("radius2") = none)
      .method("contact", [](const std::shared_ptr<Law>& law, const std::string& pair, double friction, const std::string& tangential, double shear_stiffness, double shear_damping,
                          double elastic_damping, double stretch, bool waves, double radius_a, double radius_b, double work_of_adhesion, double adhesion_range) {
            return contact(law, pair, friction, tangential, shear_stiffness, shear_damping, elastic_damping, stretch, waves, radius_a, radius_b, work_of_adhesion, adhesion_range);
          },
          arg("pair"), py::kw_only(), arg("friction") = 0.0, arg("tangential") = "history", arg("shear_stiffness") = 0.0, arg("shear_damping") = usual_shear_damping,
          arg("elastic_damping") = usual_elastic_damping, arg("stretch") = 1.0, arg("waves") = true, arg("radius_a") = 0.0, arg("radius_b") = 0.0,
          arg("work_of_adhesion") = 0.0, arg("adhesion_range") = 0.0);
  function(m, "read", [](const py::object& path) { return std::make_shared<Law>(read_law(py::str(path))); }, arg("path"));
  m.def("_table", [](const py::object& materials, const std::vector<std::string>& pairs, double tolerance, double depth, double damage_number, int jobs, const std::string& atlas,
                      const std::function<void(double)>& progress) {
    return std::const_pointer_cast<Law>(table(materials, pairs, tolerance, depth, damage_number, jobs, atlas, progress));
  });

  Class<Pair>(m, "Pair")
      .property("names", [](const Pair& p) { return p.chosen.names.first + ":" + p.chosen.names.second; })
      .property("r_eff", [](const Pair& p) { return p.chosen.r_eff; })
      .property("m_eff", [](const Pair& p) { return p.chosen.m_eff; })
      .property("largest_overlap", [](const Pair& p) { return p.chosen.limit(); })
      .property("fastest", [](const Pair& p) { return p.chosen.law.max_speed(p.chosen.r_eff, p.chosen.m_eff); })
      .method("force", [](const Pair& p, const Numbers& overlap, const std::optional<Numbers>& largest, double speed) { return evaluate<1>(p, overlap, largest, speed)[0]; }, arg("overlap"),
          arg("largest") = none, py::kw_only(), arg("speed") = 0.0)
      .method("curves",
          [](const Pair& p, const Numbers& overlap, const std::optional<Numbers>& largest, double speed) {
            const auto [force, stiffness, radius] = evaluate<3>(p, overlap, largest, speed);
            return py::make_tuple(force, stiffness, radius);
          },
          arg("overlap"), arg("largest") = none, py::kw_only(), arg("speed") = 0.0)
      .method("impact", &impact_by_law, arg("velocity"))
      .method("restitution", &restitution, arg("velocity"));

  Class<Contact>(m, "Contact")
      .property("values", &Contact::values)
      .static_method("motion", &Contact::motion, arg("n") = 1)
      .method("history", &Contact::history, arg("n") = 1)
      .method("advance", &Contact::advance, arg("motion"), arg("history"), arg("ledger") = none)
      .method("state", &Contact::state, arg("motion"), arg("history"));

  function(m, "impact",
      [](const Particle& particle, double velocity, const py::object& against, double friction, double tangential_velocity, double spin, std::array<double, 3> orientation,
          const std::string& grid, int resolution, int grids, int threads, bool estimate_error, std::function<void(double)> progress) {
        const RunChoice choice{grid, resolution, grids, threads, estimate_error, std::move(progress)};
        const Partner partner = partner_of(against);
        const Approach thrown{.velocity = velocity, .tangential_velocity = tangential_velocity, .spin = spin, .friction = friction, .orientation = orientation};
        RunResult run;
        CentreMotion centre{velocity, tangential_velocity};
        {
          const py::gil_scoped_release release;
          run = body_impact(particle, thrown, partner, choice.options(), centre);
        }
        return answer_of(particle, choice, run, centre);
      },
      arg("particle"), arg("velocity"), py::kw_only(), arg("against") = none, arg("friction") = 0.0, arg("tangential_velocity") = 0.0, arg("spin") = 0.0,
      arg("orientation") = std::array<double, 3>{0, 0, -1}, arg("grid") = "auto", arg("resolution") = 0, arg("shifted_grids") = 4, arg("threads") = 1, arg("estimate_error") = false, arg("progress") = none);
  function(m, "press",
      [](const Particle& particle, double depth, const py::object& against, const std::string& support, const std::string& grid, int resolution, int grids, int threads, bool estimate_error,
          std::function<void(double)> progress) {
        const RunChoice choice{grid, resolution, grids, threads, estimate_error, std::move(progress)};
        if (support != "free" && support != "midplane") fail("support", "is no support", support, "free or midplane");
        const PressPlan plan{.depth = depth * particle.radius, .support = support == "free" ? Support::free : Support::midplane};
        const Partner partner = partner_of(against);
        RunResult run;
        {
          const py::gil_scoped_release release;
          run = press(particle, plan, partner, choice.options());
        }
        return answer_of(particle, choice, run, {});
      },
      arg("particle"), arg("depth"), py::kw_only(), arg("against") = none, arg("support") = "free", arg("grid") = "auto", arg("resolution") = 0, arg("shifted_grids") = 4, arg("threads") = 1,
      arg("estimate_error") = false, arg("progress") = none);
  m.def("_calibrate", &calibrate_by);
  m.def("_doc", &doc);
}
