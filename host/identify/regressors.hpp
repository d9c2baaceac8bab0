#pragma once

#include <Eigen/Dense>
#include <vector>

#include "common/model/model.hpp"
#include "common/result.hpp"
#include "host/identify/motion.hpp"
#include "host/session/session.hpp"

namespace cartwright {

/// One column of the linear regression  y'' = sum_j theta_j g_j(y, v, u, t).
enum class Feature {
  voltage,    ///< u after its map, delay and lag:          theta = beta
  velocity,   ///< -v:                                      c, or gamma of exponential damping
  direction,  ///< -sgn v:                                  Coulomb level
  one,        ///< 1:                                       constant force, and k * neutral of a cable spring
  position,   ///< -y:                                      k
  speed,      ///< -|v|/2:                                  c d, asymmetric viscous friction
  drag,       ///< -v |v|
  exponential,       ///< -exp(-alpha2 |v|) v                      alpha1
  stribeck,          ///< -exp(-(v/speed)^2) sgn v                 excess
  spot,              ///< -exp(-((y - centre)/width)^2/2) sgn v    peak
  cogging_sine,      ///< sin(2 pi y/period)                       amplitude cos phase
  cogging_cosine,    ///< cos(2 pi y/period)                       amplitude sin phase
  absolute_voltage,  ///< |u|/2:                                   beta d, amplifier gain asymmetry
  warm_voltage,      ///< -u (1 - exp(-t/T)):                      beta gain_loss
};

/// The columns that a list of terms needs, and the way between the regression's numbers and a model.
class TermSet {
 public:
  /// Refuses terms that this regression cannot hold (backlash, flexible coupling, presliding, current limit,
  /// encoder faults, a push in one recording): those need the diagnosis.
  static Result<TermSet> create(const std::vector<Term>& terms);

  const std::vector<Feature>& features() const { return features_; }
  const std::vector<Term>& terms() const { return terms_; }
  bool has(Term term) const;

  /// Numbers that act nonlinearly; the regression is solved for given values of these.
  const std::vector<Parameter>& shapes() const { return shapes_; }

  /// All numbers of the model, in file order.
  const std::vector<Parameter>& parameters() const { return parameters_; }

  /// Whether a column's coefficient may not be negative.
  bool nonnegative(Feature feature) const;

  /// A model from coefficients, with the shapes of `shape`.
  Model to_model(const Eigen::VectorXd& theta, const Model& shape) const;

  /// Which columns decide on a parameter (none for shapes).
  std::vector<std::size_t> columns_of(Parameter parameter) const;

 private:
  std::vector<Term> terms_;
  std::vector<Feature> features_;
  std::vector<Parameter> shapes_, parameters_;
};

/// Mean of every column over every interval [t_k, t_(k+1)] between two rows: (rows - 1) x features. The
/// voltage is integrated over its hold, so that neither jitter nor delay shifts it by half a sample. While
/// the cart sticks friction takes up whatever acts, y'' = 0, and all columns count as zero. Shapes come from
/// `shape`.
Eigen::MatrixXd interval_means(const TermSet& terms, const Model& shape, const Recording& recording,
                               const std::vector<double>& y_m, const Velocity& velocity,
                               const std::vector<double>& u_V);

}  // namespace cartwright
