#pragma once

namespace surge::mps {

// Eq. (14)
/// A particle is on the free surface, and gets p = 0, where its number density n* < beta n0.
inline bool on_free_surface(double n, double beta, double n0) { return n < beta * n0; }

}  // namespace surge::mps
