#include "solver/run/compact.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <random>

#include "base/error.hpp"
#include "base/state_archive.hpp"
#include "solver/body/stable_step.hpp"
#include "solver/grid/spatial_grid.hpp"
#include "solver/loading/compaction.hpp"
#include "solver/run/axisymmetric_setup.hpp"
#include "solver/run/time_step.hpp"

namespace granulaw {

namespace {

/// Windows of density over which a row is the mean, centred on multiples of this; shorter from the turn on.
constexpr double load_window = 0.01, unload_window = 0.002;
/// A window cut short by a turn counts from so many steps on.
constexpr int least_steps = 10;
/// Steps between two measurements of the highest frequencies, iterations of one, and of the first.
constexpr int measure_interval = 25, measure_iterations = 3, first_iterations = 40;
/// Steps between two looks at the growth of the bounds.
constexpr int bound_interval = 5;
/// Growth of the step between two looks, at most.
constexpr double step_growth = 1.1;
/// A run counts as unstable from this error of its energy balance over the work on. Work below `small_work`
/// times yield stress and volume does not tell.
constexpr double broken_balance = 0.05, small_work = 1e-3;
/// A contact counts for the coordination from this share of the mean force on.
constexpr double least_force_share = 1e-3;

/// CPU time of all threads.
double process_seconds()
{
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double sphere_volume(double radius)
{
  return 4 * M_PI / 3 * radius * radius * radius;
}

/// Length: the mean radius; stress and density: of the material with the slowest waves.
Scales scales_of(const Packing& packing, const std::vector<Material>& materials)
{
  Scales scale{0, 0, 1};
  for (const Packing::Sphere& s : packing.spheres) {
    scale.length += s.radius / static_cast<double>(packing.spheres.size());
    const Material& m = materials[s.material];
    if (scale.stress == 0 || m.e_star() / m.density < scale.stress / scale.density)
      scale.stress = m.e_star(), scale.density = m.density;
  }
  return scale;
}

/// What bodies of one radius and material share.
struct Template
{
  Body body;
  std::shared_ptr<const SphereGridTables> tables;
  std::unique_ptr<StableStep> bound;
  std::unique_ptr<MeasuredStep> measured;
};

Template make_template(double radius, const Phase& phase, int cells, const RunOptions& options)
{
  SpatialSection s;
  s.phases = {phase};
  s.depth = [radius](const Vector3& x) { return radius - x.norm(); };
  s.normal = [](const Vector3& x) { return Vector3(x.normalized()); };
  s.mass = phase.density * sphere_volume(radius);
  const double end = radius * (1 + 1e-9);
  for (std::vector<double>& lines : s.lines)
    for (int k = 0; k <= cells; ++k) lines.push_back(end * (2.0 * k / cells - 1));
  Template t{spatial_body(s), {}, {}, {}};
  t.tables = std::make_shared<SphereGridTables>(t.body.reference(), radius);
  t.bound = std::make_unique<StableStep>(t.body);
  t.measured = std::make_unique<MeasuredStep>(t.body, nullptr, Eigen::Matrix3d::Identity());
  t.measured->limit(t.body, first_iterations);
  if (options.precision == Precision::single) t.body.use_single();
  return t;
}

/// Uniform among all turns.
Eigen::Matrix3d random_turn(std::mt19937& random)
{
  for (;;) {
    double q[4], square = 0;
    for (double& x : q) x = 2 * (random() / 4294967296.0) - 1, square += x * x;
    if (square <= 1 && square > 0.05)
      return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  }
}

void check(const Packing& packing, const CompactPlan& plan, const RunOptions& options)
{
  if (packing.spheres.empty()) fail("packing", "holds no sphere");
  for (const double side : packing.box)
    if (!(side > 0)) fail("packing", "the box has no volume", fmt::format("{:g} m", side), "over 0");
  if (!(plan.friction >= 0 && plan.friction <= 10))
    fail("--friction", "cannot be used", fmt::format("{:g}", plan.friction), "0 to 10");
  if (!(plan.rate > 0 && plan.rate <= 0.05))
    fail("--rate", "cannot be used", fmt::format("{:g}", plan.rate),
         "over 0, up to 0.05 (of the wave speed)");
  if (plan.cells < 4 || plan.cells > 40)
    fail("--cells", "cannot be used", std::to_string(plan.cells), "4 to 40 cells a diameter");
  if (!(plan.unload_to < 1))
    fail("--unload-to", "cannot be used", fmt::format("{:g}", plan.unload_to), "0 to below 1");
  if (!(options.courant >= 0.05 && options.courant <= 0.95))
    fail("--courant", "cannot be used", fmt::format("{:g}", options.courant), "0.05 to 0.95");
}

/// One packing under one plan; solver units but for what it reports.
class Assembly
{
 public:
  Assembly(const Packing& packing, const std::vector<Material>& materials, const CompactPlan& plan,
           const RunOptions& options)
      : plan_(plan),
        options_(options),
        scale_(scales_of(packing, materials)),
        threads_(std::max(1, options.threads))
  {
    place_bodies(packing, materials);
    PackingBox box{Vector3(packing.box[0], packing.box[1], packing.box[2]) / scale_.length, Vector3::Zero(),
                   !plan.walls};
    check_overlaps(box);
    auto contact = std::make_unique<PackingContact>(balls_, box, plan.friction, plan.cells, threads_);
    contact_ = contact.get();
    scene_.contact = std::move(contact), scene_.threads = &threads_;
    if (solid_ / box.volume() >= plan.density)
      fail("--density", "is below that of the packing", fmt::format("{:g}", plan.density),
           fmt::format("over {:.4g}", solid_ / box.volume()));
    const bool unloads = plan.unload_to >= 0;
    // the last window is centred on the end
    const double end = unloads ? plan.density : plan.density + 0.5 * load_window;
    drive_ = std::make_unique<Compaction>(*contact_, Compaction::Plan{solid_, end, plan.rate, unloads});
    for (const Body& body : scene_.bodies) result_.points += body.reference().filled;
  }

  CompactResult run();

 private:
  void place_bodies(const Packing& packing, const std::vector<Material>& materials);
  void check_overlaps(const PackingBox& box);
  void choose_step();
  void step();
  void end_step(bool turned);
  void begin_window();
  void end_window(bool turned);
  bool window_is_over() const;
  void add_energies(CompactRow& row);
  void visit_state(StateArchive& archive);

  CompactPlan plan_;
  RunOptions options_;
  Scales scale_;
  Parallel threads_;
  Scene scene_;
  std::vector<Ball> balls_;
  std::vector<const StableStep*> bounds_;
  std::vector<MeasuredStep> measured_;
  std::map<std::pair<double, int>, Template> templates_;
  std::vector<double> measured_limit_, bound_then_;  // by body
  PackingContact* contact_ = nullptr;
  std::unique_ptr<Compaction> drive_;
  CompactResult result_;
  double solid_ = 0, yield_ = 1e-2;  // yield: the least; of elastic bodies 1 % of E*
  // where the run is
  double time_ = 0, dt_ = 0, last_dt_ = 0, cpu_s_ = 0;
  double largest_load_ = 0, largest_work_ = 0, largest_error_ = 0, most_created_ = 0;
  long steps_ = 0;
  // the window
  bool in_window_ = false;
  double window_start_ = 0, window_from_ = 0, density_sum_ = 0, volume_sum_ = 0;
  Vector3 area_sum_ = Vector3::Zero();
  int window_steps_ = 0;
};

void Assembly::place_bodies(const Packing& packing, const std::vector<Material>& materials)
{
  std::mt19937 random(static_cast<unsigned>(plan_.seed));
  for (const Packing::Sphere& s : packing.spheres) {
    const double radius = s.radius / scale_.length;
    auto [found, is_new] = templates_.try_emplace({radius, s.material});
    Template& t = found->second;
    if (is_new) t = make_template(radius, phase_of(materials[s.material], scale_), plan_.cells, options_);
    const Ball ball{t.tables, random_turn(random),
                    Vector3(s.centre[0], s.centre[1], s.centre[2]) / scale_.length};
    Body body = t.body;  // shares the reference
    for (int i = 0; i < body.nodes(); ++i) {
      const Vector3 x = reference_place(body, i), u = ball.turn * x + ball.start - x;
      for (int d = 0; d < 3; ++d) body.u_i(i, d) = u[d];
    }
    balls_.push_back(ball), bounds_.push_back(t.bound.get());
    measured_.emplace_back(body, t.measured.get(), ball.turn);
    scene_.bodies.push_back(std::move(body));
    solid_ += sphere_volume(radius);
    yield_ = std::min(yield_, materials[s.material].yield_stress / scale_.stress);
  }
  measured_limit_.resize(balls_.size()), bound_then_.resize(balls_.size());
}

/// Of spheres with each other and with walls.
void Assembly::check_overlaps(const PackingBox& box)
{
  std::vector<Vector3> centres;
  std::vector<double> radii;
  for (const Ball& ball : balls_) centres.push_back(ball.start), radii.push_back(ball.grid().radius);
  const auto take = [&](double overlap, double radius, const std::string& who) {
    if (overlap <= 0) return;
    ++result_.start_overlaps;
    result_.largest_start_overlap = std::max(result_.largest_start_overlap, overlap / radius);
    if (overlap > most_start_overlap * radius)
      fail("packing", who + " overlap too much at the start",
           fmt::format("{:.3g} of the radius", overlap / radius),
           fmt::format("up to {:g}; relax the packing with stiffer particles, or expand it",
                       most_start_overlap));
  };
  for (const Neighbours& n : find_neighbours(centres, radii, 0, box))
    take(radii[n.a] + radii[n.b] - (centres[n.a] + box.shift(n.image) - centres[n.b]).norm(),
         std::min(radii[n.a], radii[n.b]), fmt::format("spheres {} and {}", n.a + 1, n.b + 1));
  if (box.periodic) return;
  for (std::size_t b = 0; b < balls_.size(); ++b)
    for (int d = 0; d < 3; ++d)
      for (const double way : {centres[b][d], box.length[d] - centres[b][d]})
        take(radii[b] - way, radii[b], fmt::format("sphere {} and a wall", b + 1));
}

/// The highest frequencies are measured now and then. In between, a body's limit falls as its bound does,
/// which holds for every deformation.
void Assembly::choose_step()
{
  const bool measure = steps_ % measure_interval == 0;
  if (!measure && steps_ % bound_interval != 0) return;
  std::vector<double> limits(balls_.size());
  threads_.each(static_cast<int>(balls_.size()), [&](int b, int) {
    const double bound = bounds_[b]->limit(scene_.bodies[b]);
    if (measure) {
      measured_limit_[b] = measured_[b].limit(scene_.bodies[b], measure_iterations);
      bound_then_[b] = bound;
    }
    limits[b] = measured_limit_[b] * std::min(1.0, bound / bound_then_[b]);
  });
  const double limit = options_.courant * *std::min_element(limits.begin(), limits.end());
  dt_ = steps_ == 0 ? limit : std::min(limit, step_growth * dt_);
  if (steps_ == 0) last_dt_ = dt_;
}

void Assembly::begin_window()
{
  contact_->reset_tallies();
  in_window_ = true, window_steps_ = 0;
  window_start_ = time_, window_from_ = drive_->density();
  density_sum_ = volume_sum_ = 0, area_sum_.setZero();
}

bool Assembly::window_is_over() const
{
  const double density = drive_->density();
  if (drive_->branch() == Branch::unload) return std::abs(density - window_from_) >= unload_window;
  return std::floor(density / load_window - 0.5) > std::floor(window_from_ / load_window - 0.5);
}

void Assembly::add_energies(CompactRow& row)
{
  const std::size_t count = balls_.size();
  std::vector<std::array<double, 3>> energies(count);
  threads_.each(static_cast<int>(count), [&](int b, int) {
    const Body& body = scene_.bodies[b];
    energies[b] = {body.kinetic_energy(), body.strain_energy(), body.plastic_work()};
  });
  for (const auto& [kinetic, elastic, plastic] : energies)
    row.kinetic += kinetic, row.elastic += elastic, row.plastic += plastic;
  row.work = drive_->work() + contact_->work();
  row.lost_in_contact = contact_->dissipated();
  largest_work_ = std::max(largest_work_, std::abs(row.work));
  const double error = std::abs(row.work - row.kinetic - row.elastic - row.plastic - row.lost_in_contact);
  largest_error_ = std::max(largest_error_, error);
  most_created_ = std::max(most_created_, -row.lost_in_contact);
  for (double* energy : {&row.work, &row.kinetic, &row.elastic, &row.plastic, &row.lost_in_contact})
    *energy *= scale_.energy();
  if (!(error < broken_balance * std::max(largest_work_, small_work * yield_ * solid_)))
    fail("solver",
         fmt::format(
             "the run became unstable at a density of {:.3f}: its energies miss the work by {:.2g} of it; "
             "lower --courant",
             drive_->density(), error / largest_work_));
}

void Assembly::end_window(bool turned)
{
  if (turned && window_steps_ < least_steps) return;
  const double time = time_ - window_start_;
  CompactRow row{};
  row.unloading = drive_->density() < window_from_;
  row.density = density_sum_ / time;
  const Vector3 areas = area_sum_ / time;
  for (int d = 0; d < 3; ++d) {
    row.stress[d] = scale_.stress * contact_->virial()(d, d) / volume_sum_;
    row.box[d] = scale_.length * contact_->box.length[d];
    if (!plan_.walls) continue;
    for (int side = 0; side < 2; ++side) {
      const double force = (side ? -1 : 1) * contact_->wall_impulse()[2 * d + side][d] / time;
      row.wall_force[2 * d + side] = scale_.force() * force;
      row.wall_stress[d] += 0.5 * scale_.stress * force / areas[d];
    }
  }
  const std::vector<PairTally> pairs = contact_->tallies(scene_.bodies);
  double sum = 0, sides = 0;
  for (const PairTally& p : pairs) sum += p.push;
  for (const PairTally& p : pairs) {
    if (p.push * double(pairs.size()) > least_force_share * sum) sides += p.far < 0 ? 1 : 2;
    result_.contacts.push_back({row.density, row.unloading, p.near, p.far, p.image,
                                scale_.force() * p.push / time, scale_.force() * p.slide / time,
                                scale_.length * p.distance, scale_.length * scale_.length * p.area});
  }
  row.coordination = sides / double(balls_.size());
  add_energies(row);
  result_.rows.push_back(row);
}

void Assembly::end_step(bool turned)
{
  if (in_window_) {
    ++window_steps_;
    const PackingBox& box = contact_->box;
    const Vector3 length = box.length - 0.5 * last_dt_ * box.rate;  // in the middle of the step
    density_sum_ += last_dt_ * solid_ / length.prod(), volume_sum_ += last_dt_ * length.prod();
    area_sum_ += last_dt_ * length.prod() * length.cwiseInverse();
    if (!turned && !window_is_over()) return;
    const std::size_t rows = result_.rows.size();
    end_window(turned);
    begin_window();
    if (result_.rows.size() == rows) return;
    const CompactRow& row = result_.rows.back();
    const double load = plan_.walls ? row.wall_force[5] / scale_.force()
                                    : (row.stress[0] + row.stress[1] + row.stress[2]) / scale_.stress;
    largest_load_ = std::max(largest_load_, load);
    if (row.unloading && drive_->goes_back(time_) && load <= std::max(plan_.unload_to, 1e-3) * largest_load_)
      drive_->stop();
    return;
  }
  const double before = drive_->density();  // the first whole window
  if (std::floor(before / load_window - 0.5) > std::floor(window_from_ / load_window - 0.5)) begin_window();
}

void Assembly::step()
{
  choose_step();
  const Branch branch = drive_->branch();
  const double pushed = advance(scene_, *drive_, time_, 0.5 * (last_dt_ + dt_), dt_);
  if (!std::isfinite(pushed))
    fail("solver",
         fmt::format("the run became unstable at a density of {:.3f}; lower --courant", drive_->density()));
  last_dt_ = dt_, time_ += dt_, ++steps_;
  end_step(drive_->branch() != branch);
}

void Assembly::visit_state(StateArchive& a)
{
  a.value(time_), a.value(dt_), a.value(last_dt_), a.value(cpu_s_), a.value(largest_load_),
      a.value(largest_work_);
  a.value(steps_), a.value(in_window_), a.value(window_start_), a.value(window_from_), a.value(density_sum_);
  a.value(volume_sum_), a.value(window_steps_);
  for (int d = 0; d < 3; ++d) a.value(area_sum_[d]);
  a.values(measured_limit_), a.values(bound_then_);
  for (Body& body : scene_.bodies) body.visit_state(a);
  for (MeasuredStep& m : measured_) m.visit_state(a);
  contact_->visit_state(a), drive_->visit_state(a);
  a.growing(result_.rows), a.growing(result_.contacts);
  a.value(largest_error_), a.value(most_created_);
}

CompactResult Assembly::run()
{
  const CheckpointSlot checkpoint(options_.checkpoints, "compact");
  const auto visit = [&](StateArchive& archive) { visit_state(archive); };
  window_from_ = drive_->density();
  checkpoint.resume(visit);
  const double cpu = process_seconds() - cpu_s_;
  while (!drive_->finished()) {
    step();
    if (steps_ % 16 == 0 && !drive_->finished() && checkpoint.due()) {
      cpu_s_ = process_seconds() - cpu;
      checkpoint.save(visit);
    }
    if (options_.progress && steps_ % 16 == 0) options_.progress(drive_->progress());
  }
  if (options_.progress) options_.progress(1.0);
  Vector3 momenta = -drive_->given();
  double mass = 0;
  for (const Body& body : scene_.bodies) momenta += momentum(body), mass += body.mass();
  result_.momentum = momenta.norm() / (mass * plan_.rate * contact_->box.length.maxCoeff());
  result_.energy_error = largest_error_ / largest_work_,
  result_.largest_created = most_created_ / largest_work_;
  result_.cpu_s = process_seconds() - cpu, result_.steps = steps_;
  return std::move(result_);
}

}  // namespace

CompactResult compact(const Packing& packing, const std::vector<Material>& materials, const CompactPlan& plan,
                      const RunOptions& options)
{
  check(packing, plan, options);
  for (const Material& m : materials) validate(m, "material");
  return Assembly(packing, materials, plan, options).run();
}

}  // namespace granulaw
