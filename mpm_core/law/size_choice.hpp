#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "law/law.hpp"

namespace granulaw {

/// Half-way between the neighbours of ascending shares.
inline std::vector<double> half_ways(std::span<const double> shares)
{
  std::vector<double> bounds;
  for (std::size_t k = 1; k < shares.size(); ++k) bounds.push_back(0.5 * (shares[k - 1] + shares[k]));
  return bounds;
}

/// Index of the size ratio nearest to own/sum, by half_ways() of all ratios; half-way itself goes to the
/// lower one. No division: contact loops call it.
inline std::size_t nearest_share(const std::vector<double>& bounds, double own, double sum)
{
  std::size_t k = 0;
  for (const double bound : bounds) k += static_cast<std::size_t>(own > bound * sum);
  return k;
}

/// Least and largest radius of the particles of one type; least > largest: none is known.
struct Radii
{
  double least = 1.0, largest = 0.0;

  bool known() const { return least <= largest; }
};

/// Body of a pair of types i, j whose fraction R/(R_i + R_j) of the radii distinguishes the pair's laws.
enum class ShareOf { i, j, smaller };

/// Choice of a contact's law by the two radii, as a contact loop reads it. If each type has one size, the
/// result never changes and the branch is predicted.
struct LawFinder
{
  double weight_i = 1.0, weight_j = 1.0;  ///< infinity: that radius does not count
  double least = -1.0, largest = std::numeric_limits<double>::infinity();  ///< shares of the usual law
  std::size_t usual = 0;
  const std::vector<double>* bounds = nullptr;  ///< between the laws' shares

  std::size_t nearest(double radius_i, double radius_j) const
  {
    const double sum = radius_i + radius_j, own = std::min(weight_i * radius_i, weight_j * radius_j);
    if ((own > least * sum) & !(own > largest * sum)) [[likely]]
      return usual;
    return nearest_share(*bounds, own, sum);
  }
};

/// The laws of a pair of types by size, and which of them a contact follows: the one whose fraction is
/// nearest to the fraction of the two particles. i and j may change places: the same law is found, to the
/// bit.
class SizeChoice
{
 public:
  /// `shares`: of the laws, ascending, at least one.
  SizeChoice(ShareOf whose, std::vector<double> shares)
      : whose_(whose), shares_(std::move(shares)), bounds_(half_ways(shares_))
  {
  }

  std::size_t count() const { return shares_.size(); }

  /// The finder, which keeps a pointer to this; `usual`: the law that most contacts follow.
  LawFinder finder(std::size_t usual) const
  {
    LawFinder finder;
    if (whose_ == ShareOf::j) finder.weight_i = std::numeric_limits<double>::infinity();
    if (whose_ == ShareOf::i) finder.weight_j = std::numeric_limits<double>::infinity();
    if (usual > 0) finder.least = bounds_[usual - 1];
    if (usual + 1 < count()) finder.largest = bounds_[usual];
    finder.usual = usual;
    finder.bounds = &bounds_;
    return finder;
  }
  /// A law that serves particles of these types; where there is none known, that for like sizes.
  std::size_t usual(const Radii& i, const Radii& j) const
  {
    std::size_t usual = finder(0).nearest(1.0, 1.0);
    for (std::size_t k = 0; k < count(); ++k)
      if (serves(k, i, j)) usual = k;
    return usual;
  }

  /// Shares that particles of these types have.
  struct Range
  {
    double least, largest;
  };
  Range shares_of(const Radii& i, const Radii& j) const
  {
    const auto share = [](double own, double other) { return own / (own + other); };
    if (whose_ == ShareOf::i) return {share(i.least, j.largest), share(i.largest, j.least)};
    if (whose_ == ShareOf::j) return {share(j.least, i.largest), share(j.largest, i.least)};
    const double least = std::min(share(i.least, j.largest), share(j.least, i.largest));
    const bool may_be_alike = i.least <= j.largest && j.least <= i.largest;
    return {least, may_be_alike ? 0.5 : std::min(share(i.largest, j.least), share(j.largest, i.least))};
  }

  /// True if particles of these types follow law k.
  bool serves(std::size_t k, const Radii& i, const Radii& j) const
  {
    if (!i.known() || !j.known()) return false;
    const Range range = shares_of(i, j);
    return lower(k, range) <= upper(k, range);
  }
  /// Largest distance in the fraction between law k and particles of these types that follow it; 0: none do.
  double distance(std::size_t k, const Radii& i, const Radii& j) const
  {
    if (!serves(k, i, j)) return 0.0;
    const Range range = shares_of(i, j);
    return std::max(std::abs(lower(k, range) - shares_[k]), std::abs(upper(k, range) - shares_[k]));
  }
  /// Two radii, over any length, for which law k is resolved: in the middle of the fractions for which it
  /// serves particles of these types, which are their own radii where each type has one size. Where it serves
  /// none: at the law's own share, as particles that grow in the run may come to it. Infinity: a deformable
  /// wall.
  std::pair<double, double> radii_of(std::size_t k, const Radii& i, const Radii& j) const
  {
    double share = shares_[k];
    if (serves(k, i, j)) {
      const Range range = shares_of(i, j);
      share = 0.5 * (lower(k, range) + upper(k, range));
    }
    constexpr double thick_wall = std::numeric_limits<double>::infinity();
    std::pair radii(share, 1.0 - share);
    if (share == 0.0) radii = {1.0, thick_wall};
    if (share == 1.0) radii = {thick_wall, 1.0};
    if (whose_ == ShareOf::j) std::swap(radii.first, radii.second);
    return radii;
  }

 private:
  // The fractions between which law k is the nearest one, as far as they are in `range`.
  double lower(std::size_t k, const Range& range) const
  {
    return k == 0 ? range.least : std::max(range.least, bounds_[k - 1]);
  }
  double upper(std::size_t k, const Range& range) const
  {
    return k + 1 == count() ? range.largest : std::min(range.largest, bounds_[k]);
  }

  ShareOf whose_;
  std::vector<double> shares_, bounds_;
};

/// The laws of two materials by size; those of a rigid wall are one. `a` is i.
SizeChoice size_choice(const Law& law, const std::string& a, const std::string& b);

}  // namespace granulaw
