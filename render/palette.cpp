// Chooses styles for methods from the Okabe-Ito palette without its yellow, most different colours first.
#include "render/palette.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>

namespace scanbench::render {

namespace {

constexpr std::array kColors{kBlue, kVermillion, kGreen, kPurple, kOrange, kSky, kBlack};
constexpr std::array kDashes{Dash::solid, Dash::dashed, Dash::dash_dot, Dash::dotted};
constexpr std::array kMarkers{Marker::circle, Marker::square,        Marker::triangle, Marker::diamond,
                              Marker::plus,   Marker::triangle_down, Marker::cross};
constexpr std::size_t kLooks = kColors.size() * kDashes.size() * kMarkers.size();

/// Dash and marker move on with each round of colours: the three repeat together after 28 rounds.
MethodStyle look(std::size_t index) {
  const std::size_t round = index / kColors.size();
  const std::size_t color = index % kColors.size();
  return {kColors[color], kDashes[(color + round) % kDashes.size()], kMarkers[(color + round) % kMarkers.size()]};
}

/// FNV-1a. With this salt the methods that come with this program use all colours evenly.
std::size_t look_of(std::string_view name) {
  constexpr std::uint64_t kSalt = 101521;
  std::uint64_t hash = 14695981039346656037U ^ kSalt;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
  return static_cast<std::size_t>((hash ^ hash >> 32) % kLooks);
}

}  // namespace

MethodStyle method_style(std::string_view name) {
  return look(look_of(name));
}

std::vector<MethodStyle> method_styles(std::span<const std::string> names) {
  std::set<std::string_view> left(names.begin(), names.end());
  std::map<std::string_view, std::size_t> looks;
  std::set<std::size_t> taken, colors;
  const auto take = [&](std::string_view name, std::size_t index) {
    looks[name] = index;
    taken.insert(index);
    colors.insert(index % kColors.size());
  };
  // First, by the alphabet, the methods whose own colour is free: these look as in every other figure.
  for (const std::string_view name : left)
    if (!colors.contains(look_of(name) % kColors.size())) take(name, look_of(name));
  // The others take a free colour as long as there is one, then any look that is free.
  for (const std::string_view name : left) {
    if (looks.contains(name)) continue;
    const auto is_free = [&](std::size_t index) {
      return colors.size() < kColors.size() ? !colors.contains(index % kColors.size()) : !taken.contains(index);
    };
    std::size_t index = look_of(name);
    while (taken.size() < kLooks && !is_free(index)) index = (index + 1) % kLooks;
    take(name, index);
  }
  std::vector<MethodStyle> styles;
  for (const std::string& name : names) styles.push_back(look(looks.at(name)));
  return styles;
}

Color lighten(Color color, double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  const auto mix = [s](std::uint8_t c) { return static_cast<std::uint8_t>(std::lround(c + (255.0 - c) * s)); };
  return {mix(color.r), mix(color.g), mix(color.b)};
}

}  // namespace scanbench::render
