#pragma once

namespace surge::sph {

// Eq. (24)
/// XSPH (Monaghan 1989, J. Comput. Phys. 82): particles move with v_i - eps sum_j m_j/rho_j (v_i -
/// v_j) W, here the factor of eps (v_j - v_i) for one neighbour.
template <class T>
T xsph_weight(T volume_j, T kernel_value) {
  return volume_j * kernel_value;
}

}  // namespace surge::sph
