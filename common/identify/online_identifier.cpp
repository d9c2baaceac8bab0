#include "common/identify/online_identifier.hpp"

#include <cmath>

namespace cartwright {
namespace {

constexpr std::size_t kBlocksPerTick = 8;
/// A sum whose directions are closer together than this (determinant of the matrix scaled to a unit diagonal)
/// does not fix three numbers.
constexpr double kLeastDeterminant = 1e-6;

using Matrix = std::array<OnlineVector, kOnlineUnknowns>;

/// Inverse by cofactors; false where the three directions are not apart.
bool invert(const Matrix& m, Matrix& out) noexcept {
  const auto minor = [&m](std::size_t i, std::size_t j) {
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
    return m[a][c] * m[b][d] - m[a][d] * m[b][c];
  };
  const double determinant = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
  const double scale = std::abs(m[0][0] * m[1][1] * m[2][2]);
  if (!(std::abs(determinant) > kLeastDeterminant * scale)) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) out[j][i] = minor(i, j) / determinant;
  }
  return true;
}

/// Student's t at 97.5 %, within 1 % from four degrees of freedom on.
double student_t(double degrees) noexcept {
  return 1.96 + 2.37 / degrees + 3.2 / (degrees * degrees);
}

}  // namespace

void OnlineIdentifier::restart() noexcept {
  forget_blocks();
  estimates_ = {};
}

void OnlineIdentifier::forget_blocks() noexcept {
  open_ = sum_ = {};
  next_ = count_ = cursor_ = 0;
  refining_ = false;
}

void OnlineIdentifier::add(const WeakWindow& window) noexcept {
  for (std::size_t i = 0; i < kOnlineUnknowns; ++i) {
    for (std::size_t j = 0; j < kOnlineUnknowns; ++j) open_.zx[i][j] += window.z[i] * window.x[j];
    open_.zr[i] += window.z[i] * window.response_m_per_s2;
  }
  if (++open_.windows == kWindowsPerBlock) close_block();
}

void OnlineIdentifier::close_block() noexcept {
  Block& place = blocks_[next_];
  const bool full = count_ == kBlocks;
  const auto exchange = [full](double& sum, double in, double out) { sum += full ? in - out : in; };
  for (std::size_t i = 0; i < kOnlineUnknowns; ++i) {
    for (std::size_t j = 0; j < kOnlineUnknowns; ++j) {
      exchange(sum_.zx[i][j], open_.zx[i][j], place.zx[i][j]);
    }
    exchange(sum_.zr[i], open_.zr[i], place.zr[i]);
  }
  sum_.windows += full ? 0 : open_.windows;
  place = open_;
  open_ = {};
  next_ = (next_ + 1) % kBlocks;
  if (!full) ++count_;
  if (count_ < kFewestBlocks || !invert(sum_.zx, inverse_)) return;
  for (std::size_t i = 0; i < kOnlineUnknowns; ++i) {
    theta_[i] = 0;
    for (std::size_t j = 0; j < kOnlineUnknowns; ++j) theta_[i] += inverse_[i][j] * sum_.zr[j];
  }
  scatter_ = {};
  cursor_ = 0;
  refining_ = true;
}

bool OnlineIdentifier::refine() noexcept {
  if (!refining_) return false;
  for (std::size_t done = 0; done < kBlocksPerTick && cursor_ < count_; ++done, ++cursor_) {
    const Block& block = blocks_[cursor_];
    OnlineVector left = block.zr;
    for (std::size_t i = 0; i < kOnlineUnknowns; ++i) {
      for (std::size_t j = 0; j < kOnlineUnknowns; ++j) left[i] -= block.zx[i][j] * theta_[j];
    }
    for (std::size_t i = 0; i < kOnlineUnknowns; ++i) {
      for (std::size_t j = 0; j < kOnlineUnknowns; ++j) scatter_[i][j] += left[i] * left[j];
    }
  }
  if (cursor_ < count_) return false;
  refining_ = false;
  conclude();
  return true;
}

void OnlineIdentifier::conclude() noexcept {
  const double count = static_cast<double>(count_), degrees = count - kOnlineUnknowns;
  const double factor = student_t(degrees) * std::sqrt(count / degrees);
  OnlineEstimate* const into[] = {&estimates_.gain_m_per_s2_V, &estimates_.viscous_per_s,
                                  &estimates_.coulomb_m_per_s2};
  for (std::size_t i = 0; i < kOnlineUnknowns; ++i) {
    double variance = 0;
    for (std::size_t j = 0; j < kOnlineUnknowns; ++j) {
      for (std::size_t k = 0; k < kOnlineUnknowns; ++k) {
        variance += inverse_[i][j] * scatter_[j][k] * inverse_[i][k];
      }
    }
    const double half = factor * std::sqrt(std::fmax(variance, 0));
    *into[i] = {theta_[i], theta_[i] - half, theta_[i] + half};
  }
  estimates_.windows = sum_.windows;
}

}  // namespace cartwright
