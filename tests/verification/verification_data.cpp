// Writes the numbers behind the pictures of docs/evidence/verification.md, one CSV file for each.
//
//     verification_data FOLDER [NAME...]        all, or those named: identities uniaxial pressure onset
//     impacts
//                                               convergence step energy references
//
// pictures.py FOLDER docs/evidence/verification draws them. About five minutes of CPU. R = rho = E* = 1
// throughout.
#include <fmt/os.h>

#include <filesystem>
#include <functional>
#include <iostream>
#include <set>

#include "base/scales.hpp"
#include "convergence.hpp"
#include "elastic_press.hpp"
#include "energy_audit.hpp"
#include "identities.hpp"
#include "onset_impact.hpp"
#include "references.hpp"
#include "solver/run/grid_noise.hpp"
#include "uniaxial.hpp"

using namespace granulaw;
using namespace granulaw::verification;
using File = std::function<fmt::ostream(const char* name)>;

namespace {

constexpr double poisson_ratios[] = {0, 0.2, 0.3, 0.45};

void write_identities(const File& open)
{
  fmt::ostream out = open("identities.csv");
  out.print("cells,patch,equilibrium,momentum,mass,impulse\n");
  for (const int cells : {6, 8, 12, 16, 20, 24, 32, 48}) {
    const Identities i = identities(cells);
    const Job job = plastic_impact();
    RunOptions options;
    options.resolution = cells, options.shifted_grids = 1;
    const RunResult r = impact(job.sphere, {job.velocity}, {}, options);
    const double momentum = 4.0 / 3.0 * M_PI * job.velocity * (1 + r.summary.restitution_raw);
    out.print("{},{:.3e},{:.3e},{:.3e},{:.3e},{:.3e}\n", cells, i.patch, i.equilibrium, i.momentum, i.mass,
              std::abs(impulse(r.trace) / momentum - 1));
  }
}

void write_uniaxial(const File& open)
{
  fmt::ostream out = open("uniaxial.csv");
  out.print("law,rate,strain,solver,exact\n");
  const auto write = [&](const WrittenLaw& law, double rate, int steps) {
    const auto curve = compress(law.material, 0.6, steps, rate);
    const std::size_t every = curve.size() / 150;
    for (std::size_t k = 0; k < curve.size(); k += every)
      out.print("{},{},{:.9g},{:.17g},{:.17g}\n", law.name, rate, curve[k].strain, curve[k].stress,
                exact(law, curve[k].strain, rate).stress);
  };
  for (const WrittenLaw& law : hardening_laws_written_out()) write(law, 0, 600);
  for (const WrittenLaw& law : rate_laws_written_out())
    for (const double rate : {1e-3, 1e-2, 1e-1}) write(law, rate, 3000);
}

void write_pressure(const File& open)
{
  fmt::ostream out = open("pressure.csv");
  out.print("nu,depth,cells,r_over_a,pressure,hertz,moved_surface\n");
  fmt::ostream centre = open("pressure_centre.csv");
  centre.print("nu,depth,cells,a,p0,centre_excess\n");
  const auto write = [&](double nu, double depth, int cells) {
    const PressedSphere s = press_elastic(nu, depth, cells);
    for (const PressurePoint& p : contact_pressure(s))
      out.print("{},{},{},{:.6g},{:.6g},{:.6g},{:.6g}\n", nu, depth, cells, p.r_over_a, p.pressure,
                hertz::pressure(p.r_over_a), hertz::pressure_on_moved_surface(p.r_over_a, nu, s.contact.p0));
    centre.print("{},{},{},{:.6g},{:.6g},{:.6g}\n", nu, depth, cells, s.contact.a, s.contact.p0,
                 centre_excess(s));
  };
  for (const double nu : poisson_ratios)
    for (const double depth : {5e-4, 1e-3, 2e-3, 4e-3}) write(nu, depth, 24);
  for (const int cells : {10, 12, 14, 16, 20, 32, 40}) write(0.3, 2e-3, cells);
}

void write_onset(const File& open)
{
  fmt::ostream axis = open("axis.csv");
  axis.print("nu,z_over_a,von_mises,axial,exact_von_mises,exact_axial\n");
  fmt::ostream out = open("onset.csv");
  out.print("nu,depth,ratio,exact_depth,exact_ratio\n");
  for (const double nu : poisson_ratios) {
    const PressedSphere s = press_elastic(nu, 1e-3, 24);
    for (const AxisPoint& p : along_axis(s)) {
      const hertz::AxisStress e = hertz::on_axis(p.z_over_a, nu);
      axis.print("{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", nu, p.z_over_a, p.von_mises, p.axial,
                 e.von_mises(), e.axial);
    }
    const hertz::Onset found = predicted_onset(s), e = hertz::onset(nu);
    out.print("{},{:.6g},{:.6g},{:.6g},{:.6g}\n", nu, found.depth, found.pressure_ratio, e.depth,
              e.pressure_ratio);
  }
}

void write_impacts(const File& open)
{
  fmt::ostream out = open("impacts.csv");
  out.print("nu,v_over_onset,largest_strain,radius,depth\n");
  for (const double nu : poisson_ratios)
    for (const double v : {0.94, 0.96, 0.98, 1.0, 1.02, 1.05, 1.1}) {
      const OnsetImpact i = impact_about_onset(100, nu, v, 16);
      out.print("{},{},{:.6g},{:.6g},{:.6g}\n", nu, v, i.largest_strain, i.radius, i.depth);
    }
}

void write_convergence(const File& open)
{
  fmt::ostream out = open("convergence.csv");
  out.print("job,cells,phases,e,force,delta,time,spread,energy_error\n");
  const auto write = [&](const Job& job, int cells, int shifted_grids) {
    const RunSummary s = run(job, cells, shifted_grids);
    out.print("{},{},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.6g},{:.6g}\n", job.name, cells, shifted_grids,
              s.restitution, s.force_max, s.delta_max, s.contact_time, s.restitution_spread, s.energy_error);
  };
  for (const int shifted_grids : {1, 4})
    for (const int cells : {8, 9, 10, 11, 12, 13, 14, 15, 16, 18, 20, 22, 24, 28, 32})
      write(plastic_impact(), cells, shifted_grids);
  for (const int shifted_grids : {1, 4})
    for (const int cells : {8, 9, 10, 11, 12, 13, 14, 15, 16, 18, 20, 24})
      write(elastic_impact(), cells, shifted_grids);
  // the limits: fine grids; the overlap has no grid noise, so one grid is enough
  write(plastic_impact(), 48, 8);
  write(plastic_impact(), 64, 1);
  write(elastic_impact(), 36, 8);
}

void write_step(const File& open)
{
  fmt::ostream swing = open("swing.csv");
  swing.print("courant,swing\n");
  for (const double courant : {0.95, 0.8, 0.6, 0.4, 0.3, 0.2, 0.1})
    swing.print("{},{:.6g}\n", courant, energy_swing(courant));
  fmt::ostream out = open("step.csv");
  out.print("job,cells,courant,e,energy_error\n");
  for (const Job& job : {elastic_impact(), plastic_impact()})
    for (const int cells : {8, 12, 16, 24})
      for (const double courant : {0.85, 0.6, 0.425, 0.3, 0.2125}) {
        const RunSummary s = run(job, cells, 1, courant);
        out.print("{},{},{},{:.9g},{:.6g}\n", job.name, cells, courant, s.restitution, s.energy_error);
      }
}

void write_energy(const File& open)
{
  fmt::ostream out = open("energy.csv");
  out.print("time,kinetic,elastic,plastic\n");
  const Job job = plastic_impact();
  for (const EnergyShares& s : energy_audit(job.sphere, job.velocity, 24, 200))
    out.print("{:.6g},{:.6g},{:.6g},{:.6g}\n", s.time, s.kinetic, s.elastic, s.plastic);
}

void write_references(const File& open)
{
  fmt::ostream out = open("references.csv");
  out.print("case,quantity,solver,reference\n");
  const auto line = [&](const std::string& job, const char* quantity, double solver, double reference) {
    out.print("{},{},{:.6g},{:.6g}\n", job, quantity, solver, reference);
  };
  PressPlan plan;
  plan.support = Support::midplane;
  plan.depth = 0.01;
  const TreatedLoading loading(press(reference::unit_sphere(0), plan).trace);
  for (const auto& p : reference::elastic_press)
    line(fmt::format("elastic press at {} R", p.delta), "force", loading.force(p.delta), p.force);
  for (const reference::Press& p : reference::presses) {
    plan.depth = p.depth;
    const Particle sphere = reference::unit_sphere(p.e_over_y, p.nu, p.hardening_over_e);
    const RunSummary s = press(sphere, plan).summary;
    const std::string name =
        fmt::format("E*/Y = {} H/E = {} to {} R", p.e_over_y, p.hardening_over_e, p.depth);
    line(name, "force", s.force_max * p.e_over_y, p.force);
    line(name, "e", s.restitution, p.e);
    line(name, "residual", s.delta_residual / s.delta_max, p.residual);
  }
  for (const reference::Impact& i : reference::impacts) {
    const double v = i.v_over_vy * yield_velocity(1, 0.01, 1);
    line(fmt::format("E*/Y = 100 at V/V_y = {}", i.v_over_vy), "impact e",
         impact(reference::unit_sphere(100), {v}).summary.restitution, i.e);
  }
}

}  // namespace

int main(int argc, char** argv)
{
  const std::pair<std::string, void (*)(const File&)> all[] = {{"identities", write_identities},
                                                               {"uniaxial", write_uniaxial},
                                                               {"pressure", write_pressure},
                                                               {"onset", write_onset},
                                                               {"impacts", write_impacts},
                                                               {"convergence", write_convergence},
                                                               {"step", write_step},
                                                               {"energy", write_energy},
                                                               {"references", write_references}};
  std::set<std::string> wanted(argv + std::min(argc, 2), argv + argc), unknown = wanted;
  for (const auto& [name, write] : all) unknown.erase(name);
  if (argc < 2 || !unknown.empty()) {
    std::cerr << "verification_data FOLDER [NAME...], names:";
    for (const auto& [name, write] : all) std::cerr << ' ' << name;
    std::cerr << '\n';
    return 2;
  }
  try {
    std::filesystem::create_directories(argv[1]);
    const File open = [&](const char* name) {
      return fmt::output_file((std::filesystem::path(argv[1]) / name).string());
    };
    for (const auto& [name, write] : all)
      if (wanted.empty() || wanted.count(name)) {
        std::cout << name << std::endl;
        write(open);
      }
  } catch (const std::exception& e) {
    std::cerr << "verification_data: " << e.what() << '\n';
    return 1;
  }
}
