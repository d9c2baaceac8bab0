#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/model/model.hpp"
#include "host/session/session.hpp"

namespace cartwright::blind {

/// What a cart is doing at one instant, as far as the recording shows.
struct Instant {
  double t_s = 0;  ///< from the beginning of the recording
  double y_m = 0, v_m_per_s = 0;
  double u_V = 0;
  double u_late_V[2] = {};  ///< two and four milliseconds ago
  double u_slow_V[2] = {};  ///< through lags of two and five milliseconds
};

/// The vocabulary as columns for a sparse regression of the acceleration: numbers inside a law (a period, a
/// speed, a limit) stand on a grid, each value a column of its own. Backlash, a flexible coupling,
/// presliding, a push and lost counts have none: their states are hidden, or they happen once. That is a
/// limit of the method and not of this library.
class Library {
 public:
  /// Ranges are taken from the session; the terms that the nominal model has come first and stay in.
  Library(const Session& session, const Model& nominal);

  std::size_t size() const { return names_.size(); }
  std::size_t nominal_columns() const { return nominal_; }
  const std::string& name(std::size_t column) const { return names_[column]; }  ///< the term it belongs to
  void evaluate(const Instant& at, double* columns) const;

 private:
  double travel_m_ = 0, low_m_ = 0, most_V_ = 0, typical_V_ = 0, most_speed_m_per_s_ = 0;
  double back_emf_V_s_per_m_ = 0;
  bool coulomb_known_ = false;
  std::size_t nominal_ = 0;
  std::vector<std::string> names_;

  /// Calls `column(name, value)` for each, in order.
  template <typename Take>
  void columns(const Instant& at, const Take& take) const;
};

}  // namespace cartwright::blind
