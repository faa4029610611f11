#pragma once

namespace surge {

/// What one time step did. Counts refer to this step alone.
struct StepReport {
  double dt = 0.0;            ///< s
  double courant = 0.0;       ///< v_max dt / l0
  double v_max = 0.0;         ///< m/s
  int ppe_iterations = 0;     ///< MPS: iterations of the pressure solver (0 for a direct one)
  double ppe_residual = 0.0;  ///< MPS: relative residual reached
  bool ppe_converged = true;  ///< MPS: that is within the tolerance
  double ppe_setup_s = 0.0;   ///< MPS: wall time of the preconditioner or factorisation, s
  double ppe_solve_s = 0.0;   ///< MPS: wall time of the rest of the pressure solver, s
  long particle_collisions = 0;
  long wall_collisions = 0;  ///< particles that the swept test held back from a wall
  long clipped = 0;          ///< particles whose negative pressure was set to zero
  long lost = 0;             ///< fluid particles outside the tank now
};

}  // namespace surge
