// A symmetric positive definite system in blocks of three unknowns, solved by preconditioned conjugate gradients.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace scanbench::align {

/// A block below the diagonal: column < row. Its transpose is the block above the diagonal.
struct LowerBlock {
  std::size_t row;
  std::size_t column;
  Eigen::Matrix3d value;
};

/// Conjugate gradients (Hestenes & Stiefel 1952) with the inverses of the diagonal blocks as preconditioner. Where most
/// scans of a map meet many others, the triangular factors of the matrix have few zeros, and a product with the matrix
/// costs less than a thousandth of a factorization.
class BlockSystem {
 public:
  /// `diagonal`: symmetric positive definite blocks, one for each row. Lower blocks at one place are added up.
  BlockSystem(std::vector<Eigen::Matrix3d> diagonal, std::span<const LowerBlock> lower);

  /// The solution x of A x = right, until the residual has 1e-10 of its first length in the norm of the preconditioner.
  /// Nothing if that takes more than `most` iterations, or a number is not finite.
  std::optional<std::vector<Eigen::Vector3d>> solve(std::span<const Eigen::Vector3d> right, int most) const;

 private:
  struct Entry {
    std::size_t column;
    Eigen::Matrix3d value;
  };

  void multiply(const std::vector<Eigen::Vector3d>& x, std::vector<Eigen::Vector3d>& product) const;

  std::vector<Eigen::Matrix3d> diagonal_;
  std::vector<Entry> entries_;      ///< row by row
  std::vector<std::size_t> begin_;  ///< of each row in the entries
};

}  // namespace scanbench::align
