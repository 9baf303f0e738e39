#include "solver/output/yield_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/state_archive.hpp"
#include "solver/body/kernels.hpp"

namespace granulaw {

YieldWatch::YieldWatch(std::vector<double> yield_stresses)
    : yield_stresses_(std::move(yield_stresses)),
      overlaps_(yield_stresses_.size(), std::numeric_limits<double>::infinity()),
      last_share_(yield_stresses_.size(), 0.0)
{
  for (const double yield : yield_stresses_) open_ += std::isfinite(yield) ? 1 : 0;
}

void YieldWatch::look(Body& body, double overlap)
{
  std::vector<CauchyStress> stress(static_cast<std::size_t>(body.points()));
  kernels(body).stress(body, stress.data());
  const AlignedVector<double>& volume = body.reference().volume_p;
  std::vector<double> share(yield_stresses_.size(), 0.0);
  for (const Region& region : body.reference().regions) {
    const auto m = static_cast<std::size_t>(region.material);
    double most = 0;
    for (int p = region.begin; p < region.end; ++p)
      if (volume[static_cast<std::size_t>(p)] > 0)
        most = std::max(most, stress[static_cast<std::size_t>(p)].von_mises());
    share[m] = std::max(share[m], most / yield_stresses_[m]);
  }
  for (std::size_t m = 0; m < share.size(); ++m) {
    if (share[m] < 1 || std::isfinite(overlaps_[m])) continue;
    const double t = (1 - last_share_[m]) / (share[m] - last_share_[m]);
    overlaps_[m] = last_overlap_ + t * (overlap - last_overlap_);
    --open_;
  }
  last_share_ = share;
  last_overlap_ = overlap;
}

void YieldWatch::visit_state(StateArchive& a)
{
  a.values(overlaps_), a.values(last_share_), a.value(last_overlap_), a.value(open_);
}

}  // namespace granulaw
