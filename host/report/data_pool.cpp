#include "host/report/data_pool.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

namespace cartwright::report {
namespace {

using Json = nlohmann::ordered_json;

std::string base64(const std::vector<unsigned char>& bytes) {
  static constexpr char kAlphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto at = [&](std::size_t k) { return k < bytes.size() ? std::uint32_t{bytes[k]} : 0u; };
    const std::uint32_t group = at(i) << 16 | at(i + 1) << 8 | at(i + 2);
    out += kAlphabet[group >> 18];
    out += kAlphabet[group >> 12 & 63];
    out += i + 1 < bytes.size() ? kAlphabet[group >> 6 & 63] : '=';
    out += i + 2 < bytes.size() ? kAlphabet[group & 63] : '=';
  }
  return out;
}

std::string packed_offsets(const std::vector<double>& values, double start) {
  std::vector<unsigned char> bytes;
  bytes.reserve(values.size() * 4);
  for (const double value : values) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value - start));
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<unsigned char>(bits >> shift));
  }
  return base64(bytes);
}

bool is_even_grid(const std::vector<double>& values) {
  if (values.size() < 3) return false;
  const double step = (values.back() - values.front()) / static_cast<double>(values.size() - 1);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double expected = values.front() + step * static_cast<double>(i);
    if (!(std::abs(values[i] - expected) <= 1e-7 * std::abs(step))) return false;
  }
  return true;
}

}  // namespace

Thinned without_straight_runs(const std::vector<double>& x, const std::vector<double>& y) {
  Thinned out;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const bool held = i > 0 && i + 1 < x.size() && y[i] == y[i - 1] && y[i] == y[i + 1];
    if (held) continue;
    out.x.push_back(x[i]);
    out.y.push_back(y[i]);
  }
  return out;
}

Thinned least_and_greatest(const std::vector<double>& x, const std::vector<double>& y, std::size_t budget) {
  if (x.size() <= budget) return {x, y};
  Thinned out;
  const std::size_t stretches = std::max<std::size_t>(1, budget / 4);
  for (std::size_t k = 0; k < stretches; ++k) {
    const std::size_t begin = k * x.size() / stretches, end = (k + 1) * x.size() / stretches;
    std::array<std::size_t, 4> keep{begin, begin, begin, end - 1};
    for (std::size_t i = begin; i < end; ++i) {
      if (!(y[i] >= y[keep[1]])) keep[1] = i;  // NaN is kept, so that a break in the line stays one
      if (y[i] > y[keep[2]]) keep[2] = i;
    }
    std::sort(keep.begin(), keep.end());
    for (std::size_t i = 0; i < keep.size(); ++i) {
      if (i > 0 && keep[i] == keep[i - 1]) continue;
      out.x.push_back(x[keep[i]]);
      out.y.push_back(y[keep[i]]);
    }
  }
  return out;
}

std::size_t DataPool::add(const std::vector<double>& values) {
  Json array;
  if (values.empty()) {
    array = Json::array();
  } else if (is_even_grid(values)) {
    array = {{"start", values.front()}, {"end", values.back()}, {"count", values.size()}};
  } else {
    const auto finite = std::find_if(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
    const double start = finite == values.end() ? 0 : *finite;
    array = {{"start", start}, {"offsets", packed_offsets(values, start)}};
  }
  const auto [entry, fresh] = known_.try_emplace(array.dump(), arrays_.size());
  if (fresh) arrays_.push_back(entry->first);
  return entry->second;
}

std::string DataPool::to_json() const {
  std::string out = "[";
  for (std::size_t i = 0; i < arrays_.size(); ++i) out += (i ? ",\n" : "") + arrays_[i];
  return out + "]";
}

}  // namespace cartwright::report
