#include "deck/scene.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <unordered_map>

#include "base/error.hpp"
#include "deck/script.hpp"

namespace granulaw::deck {

namespace {

/// A word that should have been a number, or is missing: the command is not followed.
[[noreturn]] void misread(const std::string& what)
{
  throw Unknown(what);
}

/// The words of a command, with a place to read on.
class Words
{
 public:
  explicit Words(const std::vector<std::string>& words, std::size_t at = 1) : words_(words), at_(at) {}
  bool more() const { return at_ < words_.size(); }
  const std::string& peek() const
  {
    if (!more()) misread("it ends too early");
    return words_[at_];
  }
  const std::string& word()
  {
    const std::string& w = peek();
    ++at_;
    return w;
  }
  double value()
  {
    const std::string& w = word();
    if (const auto n = number(w)) return *n;
    misread(fmt::format("found '{}' where a number should be", w));
  }
  /// A number of things, which must not become a huge or negative size.
  std::size_t count()
  {
    const double n = value();
    if (n < 0 || n > 1e6) misread(fmt::format("{:g} is no number of things", n));
    return static_cast<std::size_t>(n);
  }
  Vec3 vector()
  {
    Vec3 v;
    for (double& x : v) x = value();
    return v;
  }
  bool take(std::string_view keyword)
  {
    if (!more() || words_[at_] != keyword) return false;
    ++at_;
    return true;
  }
  /// Goes on behind the next occurrence of `keyword`, if there is one.
  bool seek(std::string_view keyword)
  {
    for (std::size_t k = at_; k < words_.size(); ++k)
      if (words_[k] == keyword) {
        at_ = k + 1;
        return true;
      }
    return false;
  }

 private:
  const std::vector<std::string>& words_;
  std::size_t at_;
};

struct Region
{
  Box box;
  double volume = 0;
};

struct Template
{
  int type = 1;
  double radius_min = 0, radius_max = 0, density = 0;
};

struct Distribution
{
  std::vector<std::pair<std::string, double>> parts;  // template, share of mass
};

struct Mesh
{
  std::string where;
  int type = 1;
  Box box;
  double speed = 0, drag_speed = 0;
};

/// fix move/mesh while it is on.
struct Motion
{
  std::string mesh;
  Vec3 velocity{0, 0, 0};   // linear
  Vec3 amplitude{0, 0, 0};  // wiggle
  bool turns = false;
  Vec3 origin{0, 0, 0}, axis{0, 0, 1};
  double angular_speed = 0, angle = 0;  // rad/s; rad: of a swinging one, else all around
};

struct Insertion
{
  std::vector<std::size_t> sources;                 // in Scene
  std::vector<double> shares;                       // of their number
  double total = 0, rate = 0, each = 0, every = 0;  // particles; 1/s; particles an insertion; steps
  double inserted = 0;
  bool refills = false;
};

/// Follows one deck.
class Reader
{
 public:
  Scene read(const std::string& deck, const Presets& presets);

 private:
  Scene scene_;
  Script* script_ = nullptr;
  std::map<std::string, Region> regions_;
  std::map<std::string, Template> templates_;
  std::map<std::string, Distribution> distributions_;
  std::map<std::string, Mesh> meshes_;
  std::map<std::string, Motion> motions_;
  std::map<std::string, Insertion> insertions_;
  std::map<std::string, std::vector<std::size_t>> wall_of_mesh_;
  std::map<std::string, std::string> fixes_;  // id -> style, to know what an unfix ends
  double steps_ = 0, dt_ = 0, created_ = 0;   // in the deck's own units until finish()
  double lattice_volume_ = 0;

  void execute(const Command& c);
  void fix(const Command& c);
  void region(const Command& c);
  void mesh(const Command& c, const std::string& id, Words w);
  void wall(const Command& c, const std::string& id, Words w);
  void move_mesh(const Command& c, const std::string& id, Words w);
  void property(const Command& c, Words w);
  void particle_template(const Command& c, const std::string& id, const std::string& style, Words w);
  void insertion(const Command& c, const std::string& id, const std::string& style, Words w);
  void read_data(const Command& c);
  void create_atoms(const Command& c);
  void set(const Command& c);
  void run(const Command& c);
  Box sweep(const Box& box, const Motion& m, double duration) const;
  void finish();
};

double ball(double radius)
{
  return 4.0 / 3.0 * M_PI * radius * radius * radius;
}

Scene Reader::read(const std::string& deck, const Presets& presets)
{
  scene_.deck = deck;
  Script script([this](const Command& c) { execute(c); },
                [this](std::string_view name) -> std::optional<double> {
                  if (name == "step") return steps_;
                  if (name == "dt") return dt_;
                  return {};
                });
  script_ = &script;
  for (const auto& [name, values] : presets) script.preset(name, values);
  script.read(deck);
  scene_.notes = script.notes();
  finish();
  return scene_;
}

void Reader::execute(const Command& c)
{
  // What these do has no bearing on a plan.
  static const std::set<std::string> without_bearing{"atom_modify",
                                                     "bond_coeff",
                                                     "bond_style",
                                                     "box",
                                                     "change_box",
                                                     "coarsegraining",
                                                     "communicate",
                                                     "compute",
                                                     "compute_modify",
                                                     "debug",
                                                     "delete_atoms",
                                                     "dielectric",
                                                     "dimension",
                                                     "dump",
                                                     "dump_modify",
                                                     "echo",
                                                     "fix_modify",
                                                     "group",
                                                     "hard_particles",
                                                     "info",
                                                     "log",
                                                     "minimize",
                                                     "modify_timing",
                                                     "neigh_modify",
                                                     "neighbor",
                                                     "newton",
                                                     "pair_coeff",
                                                     "partition",
                                                     "print",
                                                     "processors",
                                                     "replicate",
                                                     "restart",
                                                     "reset_timestep",
                                                     "run_style",
                                                     "shell",
                                                     "soft_particles",
                                                     "thermo",
                                                     "thermo_log",
                                                     "thermo_modify",
                                                     "thermo_style",
                                                     "undump",
                                                     "uncompute",
                                                     "write_data",
                                                     "write_dump",
                                                     "write_restart",
                                                     "quit",
                                                     "mass",
                                                     "atom_style",
                                                     "min_style",
                                                     "timer",
                                                     "suffix"};
  const std::string& name = c.words[0];
  if (without_bearing.contains(name)) {
    if (name == "atom_style" && c.words.size() > 1 && c.words[1] != "granular" && c.words[1] != "sphere")
      scene_.unknown_particles.push_back(
          fmt::format("{}: atom_style {}: only spheres are understood", c.where, c.words[1]));
    return;
  }
  try {
    if (!c.unknown.empty()) misread(c.unknown);
    Words w(c.words);
    if (name == "units")
      scene_.units = w.word();
    else if (name == "boundary") {
      for (bool& wraps : scene_.periodic) wraps = w.word() == "p";
    } else if (name == "timestep") {
      dt_ = w.value();
      if (dt_ <= 0) misread("a time step must be positive");
    } else if (name == "fix")
      fix(c);
    else if (name == "unfix") {
      const std::string id = w.word();
      insertions_.erase(id), motions_.erase(id), fixes_.erase(id);
    } else if (name == "region")
      region(c);
    else if (name == "create_box") {
      scene_.types = static_cast<int>(w.count());
      const std::string id = w.word();
      if (!regions_.contains(id)) misread(fmt::format("there is no region '{}'", id));
      scene_.domain = regions_[id].box;
    } else if (name == "lattice") {
      w.word();
      lattice_volume_ = std::pow(w.value(), 3);
    } else if (name == "read_data")
      read_data(c);
    else if (name == "read_restart") {
      const std::string what = fmt::format("{}: read_restart: its particles are not read", c.where);
      scene_.unknown_particles.push_back(what);
      scene_.unknown_heights.push_back(what);  // --drop-height stands for their kinetic energy as well
    } else if (name == "create_atoms")
      create_atoms(c);
    else if (name == "set")
      set(c);
    else if (name == "velocity") {
      w.word();
      if (w.word() != "set") misread("only 'velocity ... set' is followed");
      Vec3 v{0, 0, 0};
      for (double& x : v)
        if (w.peek() != "NULL")
          x = w.value();
        else
          w.word();
      for (Source& s : scene_.sources) s.speed = std::max(s.speed, norm(v)), s.together.clear();
    } else if (name == "pair_style") {
      for (std::size_t k = 1; k + 1 < c.words.size(); ++k) {
        if (c.words[k] == "model" && scene_.model.empty()) scene_.model = c.words[k + 1];
        if (c.words[k] == "law") scene_.law_file = path_from(c.folder, c.words[k + 1]);
        if (c.words[k] == "stretch")
          if (const auto s = number(c.words[k + 1])) scene_.stretch = *s;
        if (c.words[k] != "materials") continue;
        static const std::set<std::string> keywords{"law",
                                                    "stats",
                                                    "stretch",
                                                    "tangential_damping",
                                                    "limitForce",
                                                    "wall",
                                                    "energy",
                                                    "contactMap",
                                                    "beyondRange",
                                                    "tangentialDampingRatio",
                                                    "tangentialStiffness",
                                                    "elasticDamping",
                                                    "heatArea",
                                                    "computeElasticPotential",
                                                    "computeDissipatedEnergy",
                                                    "tangential_reduce",
                                                    "heating_tracking",
                                                    "heating_tangential_history",
                                                    "heating_tangential_no_history",
                                                    "torsionTorque"};
        scene_.material_names.clear();
        for (std::size_t n = k + 1; n < c.words.size() && !keywords.contains(c.words[n]); ++n)
          scene_.material_names.push_back(c.words[n]);
      }
    } else if (name == "run")
      run(c);
    else if (name == "displace_atoms" || name == "displace_box")
      scene_.unknown_heights.push_back(fmt::format("{}: {} is not followed", c.where, name));
    else if (name == "clear")
      misread("what came before it is kept");
    else
      misread("it is not known to mpm plan");
  } catch (const Unknown& error) {
    script_->note(c.where, fmt::format("'{}' is not followed: {}",
                                       name + (name == "fix" && c.words.size() > 3 ? " " + c.words[3] : ""),
                                       error.what()));
  }
}

void Reader::fix(const Command& c)
{
  Words w(c.words);
  const std::string id = w.word();
  w.word();  // group
  const std::string style = w.word();
  fixes_[id] = style;
  if (style == "property/global")
    property(c, w);
  else if (style == "gravity") {
    const double g = w.value();
    if (w.word() != "vector") misread("only 'gravity G vector x y z' is followed");
    const Vec3 v = w.vector();
    if (norm(v) == 0) misread("its vector is 0");
    scene_.gravity = g / norm(v) * v;
  } else if (style.starts_with("mesh/surface"))
    mesh(c, id, w);
  else if (style == "wall/gran" || style.starts_with("wall/gran/"))
    wall(c, id, w);
  else if (style == "move/mesh")
    move_mesh(c, id, w);
  else if (style.starts_with("particletemplate/"))
    particle_template(c, id, style, w);
  else if (style.starts_with("particledistribution/")) {
    w.value();  // seed
    Distribution d;
    for (std::size_t n = w.count(); n > 0; --n) {
      const std::string part = w.word();
      d.parts.emplace_back(part, w.value());
    }
    distributions_[id] = d;
  } else if (style.starts_with("insert/"))
    insertion(c, id, style, w);
  else if (style == "adapt")
    scene_.unknown_particles.push_back(
        fmt::format("{}: fix adapt changes the particles while it runs", c.where));
  else if (style == "multisphere" || style == "rigid" || style.starts_with("rigid/"))
    scene_.unknown_particles.push_back(fmt::format("{}: fix {}: bodies of several spheres", c.where, style));
  else if (style.starts_with("wall/"))
    misread("only wall/gran is read");
  else if (style == "addforce" || style == "setforce" || style == "drag" || style == "move" ||
           style.starts_with("couple/") || style.starts_with("nve/limit"))
    scene_.unknown_speeds.push_back(fmt::format("{}: fix {} changes velocities", c.where, style));
  // every other fix measures, prints or integrates
}

void Reader::property(const Command& c, Words w)
{
  const std::string name = w.word(), kind = w.word();
  if (name != "youngsModulus" && name != "YoungsModulus" && name != "poissonsRatio" &&
      name != "yieldStress" && name != "coefficientRestitution")
    return;
  if (name == "coefficientRestitution") {
    const std::size_t types = kind == "peratomtypepair" ? w.count() : 0;
    while (w.more() && types > 0) {
      const double e = w.value();
      scene_.restitution = std::min(e, scene_.restitution.value_or(1.0));
    }
    return;
  }
  if (kind != "peratomtype") misread(fmt::format("{} must be peratomtype", name));
  for (int type = 1; w.more(); ++type) {
    const double value = w.value();
    TypeMaterial& m = scene_.materials[type];
    if (name == "poissonsRatio") {
      if (!(value > -1 && value <= 0.5)) misread(fmt::format("{:g} is no Poisson's ratio", value));
      m.poisson_ratio = value;
    } else {
      if (!(value > 0)) misread(fmt::format("{} must be positive", name));
      (name == "yieldStress" ? m.yield_stress : m.youngs_modulus) = value;
    }
  }
  (void)c;
}

/// An interval of a region: numbers, INF or EDGE.
double edge(Words& w, double otherwise)
{
  if (w.take("INF") || w.take("EDGE")) return otherwise;
  return w.value();
}

void Reader::region(const Command& c)
{
  Words w(c.words);
  const std::string id = w.word(), style = w.word();
  const Box& d = scene_.domain;
  Region r;
  const auto side = [&](std::size_t k) {
    r.box.low[k] = edge(w, d.empty() ? -Box::infinity : d.low[k]);
    r.box.high[k] = edge(w, d.empty() ? Box::infinity : d.high[k]);
  };
  const auto axis = [&]() -> std::size_t {
    const std::string a = w.word();
    if (a != "x" && a != "y" && a != "z") misread(fmt::format("'{}' is no axis", a));
    return static_cast<std::size_t>(a[0] - 'x');
  };
  if (style == "block" || style == "prism") {
    for (std::size_t k = 0; k < 3; ++k) side(k);
    r.volume = r.box.volume();
  } else if (style == "cylinder" || style == "cone" || style == "wedge") {
    // cylinder: axis c1 c2 r lo hi; cone: axis c1 c2 r_lo r_hi lo hi; wedge is bounded by its cylinder
    if (style == "wedge") w.take("axis");
    const std::size_t a = axis();
    if (style == "wedge") misread("give its height by --drop-height");
    const std::size_t b = a == 0 ? 1 : 0, e = a == 2 ? 1 : 2;
    const double cb = w.value(), ce = w.value(), r_low = w.value(),
                 r_high = style == "cone" ? w.value() : r_low;
    const double radius = std::max(r_low, r_high);
    r.box.low[b] = cb - radius, r.box.high[b] = cb + radius;
    r.box.low[e] = ce - radius, r.box.high[e] = ce + radius;
    side(a);
    r.volume = M_PI / 3 * (r_low * r_low + r_low * r_high + r_high * r_high) * r.box.size()[a];
  } else if (style == "sphere") {
    const Vec3 centre = w.vector();
    const double radius = w.value();
    r.box.include(centre - Vec3{radius, radius, radius});
    r.box.include(centre + Vec3{radius, radius, radius});
    r.volume = ball(radius);
  } else if (style == "union" || style == "intersect") {
    const std::size_t n = w.count();
    for (std::size_t k = 0; k < n; ++k) {
      const std::string part = w.word();
      if (!regions_.contains(part)) misread(fmt::format("there is no region '{}'", part));
      const Region& p = regions_[part];
      if (k == 0)
        r = p;
      else if (style == "union")
        r.box.include(p.box), r.volume += p.volume;
      else
        r.box = r.box.within(p.box), r.volume = std::min(r.volume, r.box.volume());
    }
  } else if (style == "mesh/tet") {
    if (!w.seek("file")) misread("its file is missing");
    const std::string file = path_from(c.folder, w.word());
    double scale = 1;
    Vec3 move{0, 0, 0};
    if (w.seek("scale")) scale = w.value();
    if (Words m(c.words); m.seek("move")) move = m.vector();
    for (const Vec3& p : mesh_vertices(file)) r.box.include(scale * p + move);
    r.volume = r.box.volume();
  } else {
    misread(fmt::format("region style '{}' is not known to mpm plan", style));
  }
  if (Words s(c.words); s.seek("side") && s.take("out") && !d.empty()) r.box = d, r.volume = d.volume();
  regions_[id] = r;
}

void Reader::mesh(const Command& c, const std::string& id, Words w)
{
  Mesh m;
  m.where = c.where;
  std::string file;
  // scale, move and rotate act in the order of the line
  std::vector<Vec3> points;
  while (w.more()) {
    const std::string word = w.word();
    if (word == "file") {
      file = path_from(c.folder, w.word());
      points = mesh_vertices(file);
    } else if (word == "type")
      m.type = static_cast<int>(w.value());
    else if (word == "scale") {
      const double s = w.value();
      for (Vec3& p : points) p = s * p;
    } else if (word == "move") {
      const Vec3 by = w.vector();
      for (Vec3& p : points) p = p + by;
    } else if (word == "rotate") {
      if (!w.take("axis")) misread("'axis' must follow 'rotate'");
      const Vec3 axis = w.vector();
      if (!w.take("angle")) misread("'angle' must follow the axis");
      const double angle = w.value();
      for (Vec3& p : points) p = rotated(p, axis, angle);
    } else if (word == "surface_vel")
      m.drag_speed = norm(w.vector());
    else if (word == "surface_ang_vel") {
      if (!w.take("origin")) misread("'origin' must follow 'surface_ang_vel'");
      const Vec3 origin = w.vector();
      double farthest = 0, omega = 0;
      for (const Vec3& p : points) farthest = std::max(farthest, norm(p - origin));
      if (w.seek("omega")) omega = std::abs(w.value());
      m.drag_speed = omega * farthest;
    }
  }
  if (file.empty()) misread("its file is missing");
  for (const Vec3& p : points) m.box.include(p);
  meshes_[id] = m;
}

void Reader::wall(const Command& c, const std::string& id, Words w)
{
  Words own = w;
  const bool deformable = own.seek("wall") && own.word() == "deformable";
  if (Words k = w; k.seek("mesh")) {
    std::size_t n = 1;
    if (k.seek("n_meshes")) n = k.count();
    if (!k.seek("meshes")) misread("'meshes' is missing");
    for (; n > 0; --n) {
      const std::string name = k.word();
      const auto mesh = meshes_.find(name);
      if (mesh == meshes_.end()) misread(fmt::format("there is no mesh '{}'", name));
      const Mesh& m = mesh->second;
      wall_of_mesh_[name].push_back(scene_.walls.size());
      scene_.walls.push_back({m.where, name, m.type, m.box, m.speed, m.drag_speed, deformable});
    }
    return;
  }
  if (!w.seek("primitive")) misread("neither 'mesh' nor 'primitive'");
  Wall wall{c.where, id, 1, scene_.domain, 0, 0, deformable};
  if (Words t = w; t.seek("type")) wall.type = static_cast<int>(t.value());
  static const std::array<std::string, 3> planes{"xplane", "yplane", "zplane"},
      cylinders{"xcylinder", "ycylinder", "zcylinder"};
  bool known = false;
  for (std::size_t k = 0; k < 3; ++k) {
    if (Words p = w; p.seek(planes[k])) {
      wall.box.low[k] = wall.box.high[k] = p.value();
      known = true;
    }
    if (Words p = w; p.seek(cylinders[k])) {
      const std::size_t a = k == 0 ? 1 : 0, b = k == 2 ? 1 : 2;
      const double radius = p.value(), ca = p.value(), cb = p.value();
      wall.box.low[a] = ca - radius, wall.box.high[a] = ca + radius;
      wall.box.low[b] = cb - radius, wall.box.high[b] = cb + radius;
      known = true;
    }
  }
  if (!known) misread("only planes and cylinders are understood as primitives");
  if (Words s = w; s.seek("shear")) {
    s.word();
    wall.drag_speed = std::abs(s.value());
  }
  scene_.walls.push_back(wall);
}

void Reader::move_mesh(const Command& c, const std::string& id, Words w)
{
  Motion m;
  if (!w.take("mesh")) misread("'mesh' is missing");
  m.mesh = w.word();
  if (!meshes_.contains(m.mesh)) misread(fmt::format("there is no mesh '{}'", m.mesh));
  const std::string kind = w.word();
  const auto unknown = [&](const std::string& why) {
    scene_.unknown_speeds.push_back(fmt::format("{}: fix move/mesh {}: {}", c.where, kind, why));
    misread(why + ": give the speed by --speed");
  };
  const auto period = [&]() {
    double omega = 0;
    if (Words p = w; p.seek("period")) {
      const double t = p.value();
      if (t == 0) misread("its period is 0");
      omega = 2 * M_PI / std::abs(t);
    } else if (Words o = w; o.seek("omega"))
      omega = std::abs(o.value());
    else
      unknown("neither a period nor omega");
    return omega;
  };
  Mesh& mesh = meshes_[m.mesh];
  double speed = 0;
  if (kind == "linear") {
    m.velocity = w.vector();
    speed = norm(m.velocity);
  } else if (kind == "wiggle" || kind == "viblin") {
    if (kind == "viblin") unknown("its sum of harmonics is not followed");
    if (!w.seek("amplitude")) misread("its amplitude is missing");
    m.amplitude = w.vector();
    speed = norm(m.amplitude) * period();
  } else if (kind == "rotate" || kind == "riggle") {
    if (Words o = w; o.seek("origin"))
      m.origin = o.vector();
    else
      misread("its origin is missing");
    if (Words a = w; a.seek("axis")) m.axis = a.vector();
    if (norm(m.axis) == 0) misread("its axis is 0");
    m.turns = true;
    m.angular_speed = period();
    double swing = 1;  // of riggle: the largest angular speed is the amplitude (degrees) times 2 pi/T
    if (kind == "riggle") {
      if (!w.seek("amplitude")) misread("its amplitude is missing");
      swing = std::abs(w.value()) * M_PI / 180;
    }
    double farthest = 0;
    const Vec3 axis = 1 / norm(m.axis) * m.axis;
    for (const Vec3& p : mesh.box.corners()) {
      const Vec3 arm = p - m.origin;
      farthest = std::max(farthest, norm(arm - dot(arm, axis) * axis));
    }
    speed = m.angular_speed * swing * farthest;
  } else {
    unknown("this motion is not followed");
  }
  mesh.speed = std::max(mesh.speed, speed);
  motions_[id] = m;
}

Box Reader::sweep(const Box& box, const Motion& m, double duration) const
{
  Box swept = box;
  for (const Vec3& p : box.corners()) {
    swept.include(p + duration * m.velocity);
    swept.include(p + m.amplitude);
    swept.include(p - m.amplitude);
    if (!m.turns) continue;
    const Vec3 axis = 1 / norm(m.axis) * m.axis;
    const Vec3 arm = p - m.origin, along = dot(arm, axis) * axis;
    const double reach = norm(arm - along);
    for (std::size_t k = 0; k < 3; ++k) {
      const double part = reach * std::sqrt(std::max(0.0, 1 - axis[k] * axis[k]));
      Vec3 high = m.origin + along, low = high;
      high[k] += part, low[k] -= part;
      // only this coordinate of the circle is bounded here
      swept.low[k] = std::min(swept.low[k], low[k]), swept.high[k] = std::max(swept.high[k], high[k]);
    }
  }
  return swept;
}

void Reader::particle_template(const Command& c, const std::string& id, const std::string& style, Words w)
{
  if (style != "particletemplate/sphere")
    scene_.unknown_particles.push_back(fmt::format("{}: {}: only spheres are understood", c.where, style));
  Template t;
  if (Words k = w; k.seek("atom_type")) t.type = static_cast<int>(k.value());
  const auto range = [&](const char* keyword, double& low, double& high) {
    Words k = w;
    if (!k.seek(keyword)) return;
    if (k.take("constant"))
      low = high = k.value();
    else if (k.take("uniform"))
      low = k.value(), high = k.value();
    else if (k.take("gaussian")) {
      if (!k.take("number")) k.take("mass");
      const double mean = k.value(), sigma = k.value();
      low = std::max(0.1 * mean, mean - 3 * sigma), high = mean + 3 * sigma;
    } else
      misread(fmt::format("the {} '{}' is not understood", keyword, k.peek()));
  };
  range("radius", t.radius_min, t.radius_max);
  double least = 0;
  range("density", least, t.density);
  if (t.radius_max < 0 || t.radius_min < 0 || t.density < 0) misread("radius and density must be positive");
  templates_[id] = t;
}

void Reader::insertion(const Command& c, const std::string& id, const std::string& style, Words w)
{
  Insertion in;
  Region place;
  double speed = 0, mass = 0, mass_rate = 0, fraction = 0, in_region = 0;
  std::string distribution;
  bool once = false;
  in.every = 0;
  while (w.more()) {
    const std::string word = w.word();
    if (word == "distributiontemplate")
      distribution = w.word();
    else if (word == "vel") {
      if (w.take("constant"))
        speed = norm(w.vector());
      else if (w.take("uniform") || w.take("gaussian")) {
        const bool gaussian =
            c.words[static_cast<std::size_t>(std::find(c.words.begin(), c.words.end(), "vel") -
                                             c.words.begin()) +
                    1] == "gaussian";
        const Vec3 mean = w.vector(), spread = w.vector();
        Vec3 most;
        for (std::size_t k = 0; k < 3; ++k)
          most[k] = std::abs(mean[k]) + (gaussian ? 3 : 1) * std::abs(spread[k]);
        speed = norm(most);
      }
    } else if (word == "region") {
      const std::string name = w.word();
      if (!regions_.contains(name)) misread(fmt::format("there is no region '{}'", name));
      place = regions_[name];
    } else if (word == "insertion_face") {
      const std::string name = w.word();
      if (!meshes_.contains(name)) misread(fmt::format("there is no mesh '{}'", name));
      place.box = meshes_[name].box;
    } else if (word == "nparticles") {
      if (!w.take("INF")) in.total = w.value();
    } else if (word == "mass") {
      if (!w.take("INF")) mass = w.value();
    } else if (word == "particlerate" || word == "nflowrate")
      in.rate = w.value();
    else if (word == "massrate" || word == "massflowrate")
      mass_rate = w.value();
    else if (word == "particles_in_region")
      in_region = w.value();
    else if (word == "mass_in_region")
      mass = w.value(), in.refills = true;
    else if (word == "volumefraction_region")
      fraction = w.value();
    else if (word == "insert_every") {
      if (w.take("once"))
        once = true;
      else
        in.every = w.value();
    }
  }
  const auto d = distributions_.find(distribution);
  if (d == distributions_.end()) misread(fmt::format("there is no particledistribution '{}'", distribution));

  // shares of number; the distribution's weights are shares of mass (LIGGGHTS's default)
  std::vector<Template> parts;
  double numbers = 0;
  for (const auto& [name, weight] : d->second.parts) {
    if (!templates_.contains(name)) misread(fmt::format("there is no particletemplate '{}'", name));
    const Template& t = templates_[name];
    const double mean = 0.5 * (t.radius_min + t.radius_max);
    const double one = ball(mean) * t.density;
    const double share = d->second.parts.size() == 1 ? 1.0 : one > 0 ? weight / one : 0.0;
    parts.push_back(t);
    in.shares.push_back(share);
    numbers += share;
  }
  double mean_mass = 0, mean_volume = 0;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    in.shares[k] = numbers > 0 ? in.shares[k] / numbers : 1.0 / static_cast<double>(parts.size());
    const double volume = ball(0.5 * (parts[k].radius_min + parts[k].radius_max));
    mean_mass += in.shares[k] * volume * parts[k].density;
    mean_volume += in.shares[k] * volume;
    Source s;
    s.where = c.where;
    s.type = parts[k].type;
    s.radius_min = parts[k].radius_min, s.radius_max = parts[k].radius_max;
    s.density = parts[k].density;
    s.centres = place.box;
    s.speed = speed;
    in.sources.push_back(scene_.sources.size());
    scene_.sources.push_back(s);
  }
  if (mass > 0 && mean_mass > 0) in.total = mass / mean_mass;
  if (mass_rate > 0 && mean_mass > 0) in.rate = mass_rate / mean_mass;
  if (fraction > 0 && mean_volume > 0) in_region = fraction * place.volume / mean_volume;
  if (in_region > 0) {  // insert/pack: brings the region to this number, again at every insertion
    in.each = in_region;
    if (once || in.every == 0) in.total = in_region;
  }
  if (in.total == 0 && in.rate == 0 && in.each == 0)
    scene_.unknown_particles.push_back(
        fmt::format("{}: {}: how many particles is not understood", c.where, style));
  insertions_[id] = in;
}

void Reader::read_data(const Command& c)
{
  Words w(c.words);
  const std::string path = path_from(c.folder, w.word());
  std::error_code ignored;
  std::ifstream in(path);
  if (!in || !std::filesystem::is_regular_file(path, ignored))
    fail(c.where, "the file of read_data cannot be read", "'" + path + "'");
  std::map<int, Source> by_type;
  std::unordered_map<double, Source*> of_id;  // for the speeds, which come after the atoms
  std::string line;
  bool atoms = false, velocities = false, first = true;
  double n_atoms = 0;
  int number_of_line = 0;
  while (std::getline(in, line)) {
    ++number_of_line;
    if (first) {  // a title
      first = false;
      continue;
    }
    if (const auto comment = line.find('#'); comment != std::string::npos) line.resize(comment);
    const auto words = Script::split(line);
    if (words.empty()) continue;
    if (!number(words[0])) {  // a section's name
      atoms = words[0] == "Atoms";
      velocities = words[0] == "Velocities";
      continue;
    }
    const auto numbers = [&](auto& v, const char* section, const char* columns) {
      const std::string where = fmt::format("{}:{}", path, number_of_line);
      if (words.size() < v.size())
        fail(where, fmt::format("found {} words in a line of {}", words.size(), section), "", columns);
      for (std::size_t k = 0; k < v.size(); ++k) {
        const auto n = number(words[k]);
        if (!n) fail(where, "is no number", "'" + words[k] + "'");
        v[k] = *n;
      }
    };
    if (velocities) {
      std::array<double, 4> v{};  // the angular velocity that follows moves no centre
      numbers(v, "Velocities", "id vx vy vz");
      const auto s = of_id.find(v[0]);
      if (s == of_id.end())
        fail(fmt::format("{}:{}", path, number_of_line), "Velocities of an atom that Atoms lacks", words[0]);
      s->second->speed = std::max(s->second->speed, norm(Vec3{v[1], v[2], v[3]}));
      if (s->second->speed > 0) s->second->together.clear();
      continue;
    }
    if (!atoms) {
      if (words.size() == 2 && words[1] == "atoms") n_atoms = *number(words[0]);
      if (words.size() == 3 && words[1] == "atom" && words[2] == "types")
        scene_.types = static_cast<int>(std::clamp(*number(words[0]), 0.0, 1e4));
      for (std::size_t k = 0; k < 3; ++k)
        if (words.size() == 4 && words[2] == std::string(1, static_cast<char>('x' + k)) + "lo") {
          const auto low = number(words[0]), high = number(words[1]);
          if (low && high) scene_.domain.low[k] = *low, scene_.domain.high[k] = *high;
        }
      continue;
    }
    std::array<double, 7> v{};  // atom_style granular
    numbers(v, "Atoms", "id type diameter density x y z");
    Source& s = by_type[static_cast<int>(std::clamp(v[1], 0.0, 1e6))];
    const double radius = 0.5 * v[2];
    const bool alike = s.count == 0 || (static_cast<double>(s.together.size()) == s.count &&
                                        radius == s.radius_max && v[3] == s.density);
    if (alike)
      s.together.push_back({v[4], v[5], v[6]});
    else
      s.together.clear();
    s.radius_min = s.count == 0 ? radius : std::min(s.radius_min, radius);
    s.radius_max = std::max(s.radius_max, radius);
    s.density = std::max(s.density, v[3]);
    s.centres.include(Vec3{v[4], v[5], v[6]});
    s.count += 1;
    of_id[v[0]] = &s;
  }
  if (n_atoms > 0 && by_type.empty())
    script_->note(c.where, fmt::format("'{}' holds no section Atoms", path));
  for (auto& [type, s] : by_type) {
    s.type = type;
    s.where = path;
    created_ += s.count;
    scene_.sources.push_back(s);
  }
}

void Reader::create_atoms(const Command& c)
{
  Words w(c.words);
  Source s;
  s.where = c.where;
  s.type = static_cast<int>(w.value());
  const std::string style = w.word();
  if (style == "single") {
    s.centres.include(w.vector());
    s.count = 1;
  } else if (style == "region" || style == "box") {
    Region place{scene_.domain, scene_.domain.volume()};
    if (style == "region") {
      const std::string name = w.word();
      if (!regions_.contains(name)) misread(fmt::format("there is no region '{}'", name));
      place = regions_[name];
    }
    s.centres = place.box;
    if (lattice_volume_ > 0) s.count = std::ceil(place.volume / lattice_volume_);
  } else if (style == "random") {
    s.count = w.value();
    w.value();
    const std::string name = w.word();
    s.centres = name == "NULL" ? scene_.domain : regions_[name].box;
  } else {
    misread(fmt::format("'{}' is not understood", style));
  }
  created_ += s.count;
  scene_.sources.push_back(s);
}

void Reader::set(const Command& c)
{
  Words w(c.words);
  const std::string kind = w.word(), which = w.word();
  int of_type = 0;
  if (kind == "type") of_type = static_cast<int>(number(which).value_or(0));
  Vec3 v{0, 0, 0};
  bool moves = false;
  double radius = 0, density = 0;
  while (w.more()) {
    const std::string word = w.word();
    if (word == "diameter")
      radius = 0.5 * w.value();
    else if (word == "density")
      density = w.value();
    else if (word == "vx" || word == "vy" || word == "vz")
      v[static_cast<std::size_t>(word[1] - 'x')] = w.value(), moves = true;
    else if (word == "shape")
      scene_.unknown_particles.push_back(fmt::format("{}: set shape: only spheres are understood", c.where));
    else if (word == "x" || word == "y" || word == "z")
      scene_.unknown_heights.push_back(fmt::format("{}: set {}: heights change", c.where, word));
  }
  for (Source& s : scene_.sources) {
    if (of_type != 0 && s.type != of_type) continue;
    s.together.clear();
    if (radius > 0) {
      s.radius_min =
          s.radius_min > 0 && kind != "group" && kind != "type" ? std::min(s.radius_min, radius) : radius;
      s.radius_max = kind != "group" && kind != "type" ? std::max(s.radius_max, radius) : radius;
    }
    if (density > 0) s.density = density;
    if (moves) s.speed = std::max(s.speed, norm(v));
  }
}

void Reader::run(const Command& c)
{
  Words w(c.words);
  double steps = w.value();
  if (w.take("upto")) steps -= steps_;
  if (Words k = w; k.seek("every"))
    script_->note(c.where, "the commands of 'run ... every' are not followed");
  if (!(steps >= 0)) misread("it would run backwards");
  const double duration = steps * dt_, before = scene_.count();
  for (auto& [id, in] : insertions_) {
    double more = in.total > 0 ? in.total - in.inserted : Box::infinity;
    if (in.rate > 0) more = std::min(more, in.rate * duration);
    if (in.rate == 0 && in.each > 0) {
      const double times = in.every > 0 ? std::floor(steps / in.every) + 1 : 1;
      more = std::min(more, in.each * times);
    }
    if (!std::isfinite(more)) more = 0;
    in.inserted += more;
    for (std::size_t k = 0; k < in.sources.size(); ++k)
      scene_.sources[in.sources[k]].count += more * in.shares[k];
  }
  for (auto& [id, m] : motions_) {
    Mesh& mesh = meshes_[m.mesh];
    const Box swept = sweep(mesh.box, m, duration);
    for (const std::size_t k : wall_of_mesh_[m.mesh]) {
      scene_.walls[k].box.include(swept);
      scene_.walls[k].speed = std::max(scene_.walls[k].speed, mesh.speed);
    }
    mesh.box.include(swept);
  }
  if (dt_ == 0 && steps > 0) script_->note(c.where, "no time step is set before this run");
  steps_ += steps;
  scene_.runs.push_back({c.where, steps, dt_, 0.5 * (before + scene_.count())});
}

void Reader::finish()
{
  scene_.time_step = dt_;
  if (scene_.units == "si") return;
  if (scene_.units != "cgs")
    fail(scene_.deck, "its units cannot be planned with (LIGGGHTS's own, where a deck says none, are lj)",
         "units " + scene_.units, "units si, units cgs");
  constexpr double length = 0.01, density = 1000, pressure = 0.1;
  const auto scale = [](Box& box) { box.low = length * box.low, box.high = length * box.high; };
  scene_.gravity = length * scene_.gravity;
  scale(scene_.domain);
  for (auto& [type, m] : scene_.materials) {
    if (m.youngs_modulus) *m.youngs_modulus *= pressure;
    if (m.yield_stress) *m.yield_stress *= pressure;
  }
  for (Source& s : scene_.sources) {
    s.radius_min *= length, s.radius_max *= length, s.speed *= length, s.density *= density;
    scale(s.centres);
    for (Vec3& p : s.together) p = length * p;
  }
  for (Wall& wall : scene_.walls) {
    wall.speed *= length, wall.drag_speed *= length;
    scale(wall.box);
  }
}

}  // namespace

double Scene::count() const
{
  double sum = 0;
  for (const Source& s : sources) sum += s.count;
  return sum;
}

Scene read_scene(const std::string& deck, const Presets& presets)
{
  return Reader().read(deck, presets);
}

}  // namespace granulaw::deck
