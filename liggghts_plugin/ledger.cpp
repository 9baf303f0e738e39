#include "liggghts_plugin/ledger.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace granulaw::plugin {

namespace {

std::string histogram_json(const LogHistogram& histogram, const char* quantity)
{
  int low = 0, high = LogHistogram::bins - 1;
  while (low < high && histogram.count[low] == 0) ++low;
  while (high > low && histogram.count[high] == 0) --high;
  std::string edges, counts;
  for (int b = low; b <= high; ++b) {
    edges += fmt::format("{}{:.6g}", b > low ? ", " : "", histogram.lower_edge(b));
    counts += fmt::format("{}{:.10g}", b > low ? ", " : "", histogram.count[b]);
  }
  return fmt::format(
      "{{\"quantity\": \"{}\", \"bins_per_decade\": {}, \"lower_edge\": [{}], \"count\": [{}]}}", quantity,
      LogHistogram::per_decade, edges, counts);
}

std::string side_json(const ContactLedger::Side& s)
{
  return fmt::format(
      "{{\n"
      "    \"normal_dissipation_J\": {:.10g},\n"
      "    \"contacts_begun\": {:.10g},\n"
      "    \"contacts_ended\": {:.10g},\n"
      "    \"impact_speed_max_m_per_s\": {:.8g},\n"
      "    \"overlap_over_radius_max\": {:.8g},\n"
      "    \"inertia_number_max\": {:.8g},\n"
      "    \"contact_steps_beyond_table\": {:.10g},\n"
      "    \"contacts_beyond_speed_axis\": {:.10g},\n"
      "    \"impact_speed\": {},\n"
      "    \"largest_overlap_over_radius\": {}\n"
      "  }}",
      s.dissipated, s.touches, s.ended, s.speed_max, s.overlap_max, s.inertia_max, s.beyond, s.too_fast,
      histogram_json(s.speed, "approach speed at first touch, m/s"),
      histogram_json(s.overlap, "largest overlap/R* of each contact that ended"));
}

}  // namespace

std::string to_json(const ContactLedger& ledger, const std::string& header)
{
  return fmt::format("{{\n{}  \"pair\": {},\n  \"wall\": {}\n}}\n", header, side_json(ledger.pair),
                     side_json(ledger.wall));
}

}  // namespace granulaw::plugin
