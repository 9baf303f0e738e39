#include "calibrate/design.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "calibrate/fit.hpp"
#include "calibrate/kind/composed.hpp"
#include "calibrate/kind/kind.hpp"

namespace granulaw {

namespace {

/// Fills in the values that this material would show.
void fill(Measurement& m, const CandidateMaterial& material, const Atlas& atlas,
          const std::vector<Parameter>& varied, double relative_sd)
{
  const SphereLaws laws(atlas, material);
  std::optional<ComposedModel> composed;
  if (m.is_composed()) composed.emplace(atlas, m, varied);
  const std::vector<double> values =
      m.kind->predict(m, {material, laws, {}, composed ? &*composed : nullptr}).values;
  const double largest = *std::max_element(values.begin(), values.end());
  for (std::size_t k = 0; k < values.size(); ++k) {
    m.data[k].y = values[k];
    m.data[k].sd = relative_sd * std::max(values[k], 0.01 * largest);
  }
}

}  // namespace

Design::Design(const Atlas& atlas, CalibrationRequest request, const CandidateMaterial& assumed,
               std::vector<DesignCandidate> candidates, double relative_sd)
    : candidates_(std::move(candidates))
{
  if (candidates_.empty()) fail("design", "no measurement is to be considered");
  std::vector<Measurement>& all = request.measurements;
  const auto given = static_cast<std::ptrdiff_t>(all.size());
  struct Rows
  {
    std::ptrdiff_t measurement;
    std::size_t first, count;
  };
  std::vector<Rows> rows;
  // single rows of a kind are one measurement, whose model errors they share; each curve is one of its own
  for (const DesignCandidate& c : candidates_) {
    const Kind& kind = *c.form.kind;
    auto own = kind.planned ? all.end()
                            : std::find_if(all.begin() + given, all.end(),
                                           [&](const Measurement& m) { return m.kind == &kind; });
    if (own == all.end()) {
      own = all.insert(own, c.form);
      own->source = kind.name, own->fit_offset = kind.has_machine;
    }
    const std::vector<Datum> planned =
        kind.planned ? kind.planned(c.place) : std::vector{Datum{c.place, 1, 1, 1}};
    rows.push_back({own - all.begin(), own->data.size(), planned.size()});
    own->data.insert(own->data.end(), planned.begin(), planned.end());
  }
  std::vector<std::size_t> first_rows{0};
  for (auto m = all.begin(); m != all.end(); ++m) {
    if (m - all.begin() >= given) fill(*m, assumed, atlas, request.fit, relative_sd);
    first_rows.push_back(first_rows.back() + m->data.size());
  }
  request.robust = false, request.planned = true;
  const CalibrationProblem problem(atlas, std::move(request));
  Coordinates q = Coordinates::Zero(static_cast<Eigen::Index>(problem.count()));
  for (std::size_t k = 0; k < problem.request().fit.size(); ++k) {
    const Parameter p = problem.request().fit[k];
    q[static_cast<Eigen::Index>(k)] = problem.coordinate(k, value_of(assumed, p));
    const double value = value_of(assumed, p);
    shares_.push_back(p == Parameter::hardening_modulus
                          ? (value + problem.unknowns()[k].scale) / (value + 0.5 * assumed.yield_stress)
                          : 1.0);
  }
  const Eigen::MatrixXd jacobian = jacobian_at(problem, q);
  const auto block = [&](std::size_t first, std::size_t count) {
    const auto part = jacobian.middleRows(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(count));
    return Eigen::MatrixXd(part.transpose() * part);
  };
  const std::size_t rows_there = first_rows[static_cast<std::size_t>(given)], data = problem.data_count();
  there_ = block(0, rows_there) + block(data, static_cast<std::size_t>(jacobian.rows()) - data);
  there_.diagonal().array() += 1e-6;  // of directions that nothing determines
  for (const Rows& r : rows)
    information_.push_back(block(first_rows[static_cast<std::size_t>(r.measurement)] + r.first, r.count));
}

Eigen::MatrixXd Design::information(const std::vector<std::size_t>& chosen) const
{
  Eigen::MatrixXd sum = there_;
  for (const std::size_t k : chosen) sum += information_[k];
  return sum;
}

ExpectedIntervals Design::expected(const std::vector<std::size_t>& chosen) const
{
  const Eigen::MatrixXd covariance = information(chosen).inverse();
  ExpectedIntervals widths;
  for (std::size_t k = 0; k < shares_.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    widths.push_back(normal95 * shares_[k] * std::sqrt(covariance(i, i)));
  }
  return widths;
}

double Design::spread(const std::vector<std::size_t>& chosen) const
{
  double sum = 0;
  for (const double width : expected(chosen)) sum += std::log(width);
  return sum;
}

std::vector<std::size_t> Design::best(std::size_t count) const
{
  std::vector<std::size_t> chosen;
  while (chosen.size() < count) {
    std::size_t next = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      chosen.push_back(k);
      if (const double s = spread(chosen); s < least) least = s, next = k;
      chosen.pop_back();
    }
    chosen.push_back(next);
  }
  return chosen;
}

}  // namespace granulaw
