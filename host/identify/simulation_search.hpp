#pragma once

#include <Eigen/Dense>
#include <functional>
#include <vector>

#include "host/evaluate/replay.hpp"
#include "host/identify/simulation_parameters.hpp"

namespace cartwright {

/// A recording, or a part of one, with the time at which all of it began.
struct SimulatedPiece {
  const Recording* recording;
  ReplayOptions replay;
};

/// Levenberg-Marquardt over some numbers of a model, on the errors of whole pieces simulated from their
/// voltage. Every number is counted in units of its natural size and stays within what a model may hold.
class SimulationSearch {
 public:
  SimulationSearch(std::vector<SimulatedPiece> pieces, std::vector<SlowParameter> free, unsigned threads)
      : pieces_(std::move(pieces)), free_(std::move(free)), threads_(threads) {}

  /// The most iterations that one `run` takes.
  static int most_iterations();

  /// Readings less simulation [m], piece by piece, without the rows that gave the start states.
  std::vector<Eigen::VectorXd> errors(const Model& model) const;

  /// The best model near `start`; `tick` is called after every iteration. Wide differences come first,
  /// because sticking makes the cost uneven. Afterwards `curvature` and `slope` are those at the best model.
  Model run(const Model& start, const std::function<void()>& tick);

  std::vector<Eigen::MatrixXd> curvature;  ///< J' J of every piece [m^2]
  std::vector<Eigen::VectorXd> slope;      ///< J' e of every piece [m^2]

  Eigen::MatrixXd total_curvature() const;
  Eigen::VectorXd total_slope() const;

 private:
  void linearise(const Model& model, const std::vector<Eigen::VectorXd>& at, double reach);
  Eigen::VectorXd step(const Model& model, double damping) const;
  Model moved(const Model& model, const Eigen::VectorXd& by) const;

  std::vector<SimulatedPiece> pieces_;
  std::vector<SlowParameter> free_;
  unsigned threads_;
};

}  // namespace cartwright
