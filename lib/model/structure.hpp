#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>

namespace impulse {

/// A linear elastic body after discretisation, M ü + C u̇ + K u = Σᵢ cᵢ Fᵢ; fixed degrees of freedom are already
/// removed. What every finite-element or Ritz body becomes: whoever fills it gets modes, responses and time
/// integration. Finite elements fill a Structure, Ritz series a DenseStructure.
template <class Matrix>
struct BasicStructure {
  Matrix stiffness;          ///< K, n × n, symmetric positive semidefinite [N/m]
  Matrix mass;               ///< M, n × n, symmetric positive definite [kg]
  Eigen::VectorXd dashpots;  ///< diagonal of C [kg/s]; empty if there are none
  Eigen::MatrixXd
      contacts;  ///< n × p; column i is cᵢ: cᵢᵀu is the displacement *in the direction of the force* (into the body)
  Eigen::MatrixXd outputs;               ///< n × q functionals of the displacement, for reports
  Eigen::MatrixXd wave_admittance;       ///< p × p, H(0+) of the continuous body [m/(N s)]; zero where it has none
  Eigen::MatrixXd residual_flexibility;  ///< R, p × p [m/N]: what the contacts move at once beyond cᵀu, RF, the static
                                         ///< answer of modes that were left out; empty: none
  Eigen::VectorXd translation;  ///< rigid motion r with c₁ᵀr = 1 and Kr = 0, for bodies that arrive with a speed;
                                ///< empty: all degrees of freedom alike, if that is one
};

using Structure = BasicStructure<Eigen::SparseMatrix<double>>;
using DenseStructure = BasicStructure<Eigen::MatrixXd>;

}  // namespace impulse
