#include "host/diagnose/fit/block_covariance.hpp"

namespace cartwright {

Eigen::MatrixXd block_covariance(const std::vector<Block>& blocks, double white_variance) {
  constexpr double kMostInOneBlock = 0.5;
  if (blocks.empty() || blocks.front().score.size() == 0) return {};
  Eigen::MatrixXd h = blocks.front().information;
  for (std::size_t b = 1; b < blocks.size(); ++b) h += blocks[b].information;
  h.diagonal() += 1e-12 * h.diagonal() + Eigen::VectorXd::Constant(h.rows(), 1e-30);  // definite
  // In the basis that makes H the unit matrix a block's information has its shares for eigenvalues.
  const Eigen::LLT<Eigen::MatrixXd> root(h);
  const auto whitened = [&](const auto& of) { return root.matrixL().solve(of).eval(); };
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(h.rows(), h.cols());
  for (const Block& block : blocks) {
    const Eigen::MatrixXd half = whitened(block.information);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> shares(whitened(half.transpose().eval()));
    const Eigen::VectorXd left = 1 - shares.eigenvalues().array().min(kMostInOneBlock);
    const Eigen::VectorXd along = shares.eigenvectors().transpose() * whitened(block.score);
    const Eigen::VectorXd moved = root.matrixU().solve(shares.eigenvectors() * along.cwiseQuotient(left));
    covariance += moved * moved.transpose();
  }
  const Eigen::MatrixXd inverse = root.solve(Eigen::MatrixXd::Identity(h.rows(), h.cols()));
  const Eigen::VectorXd widen =
      (white_variance * inverse.diagonal().array() / covariance.diagonal().array().max(1e-300))
          .max(1.0)
          .sqrt();
  return widen.asDiagonal() * covariance * widen.asDiagonal();
}

}  // namespace cartwright
