#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace surge {

template <int D>
using Vec = std::array<double, D>;

/// Allocator of cache-line-aligned memory, so that vector loads never straddle lines. resize(n)
/// leaves new numbers as they are: the loop that writes them first, by all threads, decides in
/// whose memory they lie. resize(n, value) and assign() set them.
template <class T>
struct AlignedAllocator {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};

  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) noexcept {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), alignment)); }
  void deallocate(T* p, std::size_t) noexcept { ::operator delete(p, alignment); }
  template <class U>
  void construct(U* p) noexcept(std::is_nothrow_default_constructible_v<U>) {
    ::new (static_cast<void*>(p)) U;
  }
  template <class U, class... Args>
  void construct(U* p, Args&&... args) {
    ::new (static_cast<void*>(p)) U(std::forward<Args>(args)...);
  }
  template <class U>
  bool operator==(const AlignedAllocator<U>&) const noexcept {
    return true;
  }
};

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;
using Field = AlignedVector<double>;

/// Loops whose work differs from particle to particle (walls have little of it) hand it to the
/// threads in stretches of this length, in turn.
inline constexpr int stretch = 1024;

/// The values written to frames, in this order.
enum class ParticleType : std::uint8_t { fluid = 0, wall = 1, dummy = 2 };

/// Particles as structure of arrays. The order changes during a run (particles are kept in cell
/// order); `id` names a particle for good.
template <int D>
struct Particles {
  std::array<Field, D> x;  ///< position, m
  std::array<Field, D> v;  ///< velocity, m/s; zero for walls that do not move
  Field pressure;          ///< Pa
  Field density;           ///< SPH: rho, kg/m3. MPS: particle number density n, dimensionless
  AlignedVector<ParticleType> type;
  AlignedVector<std::int32_t> id;

  [[nodiscard]] std::size_t size() const { return id.size(); }
  [[nodiscard]] Vec<D> position(std::size_t i) const {
    Vec<D> p;
    for (int a = 0; a < D; ++a) p[a] = x[a][i];
    return p;
  }
  [[nodiscard]] Vec<D> velocity(std::size_t i) const {
    Vec<D> u;
    for (int a = 0; a < D; ++a) u[a] = v[a][i];
    return u;
  }

  /// New particles are fluid at rest in the origin.
  void resize(std::size_t n) {
    for (int a = 0; a < D; ++a) {
      x[a].resize(n, 0.0);
      v[a].resize(n, 0.0);
    }
    pressure.resize(n, 0.0);
    density.resize(n, 0.0);
    type.resize(n, ParticleType::fluid);
    id.resize(n, 0);
  }

  /// Calls f(name, member) for all members, for those who keep particles. A new member that is left
  /// out here does not compile.
  template <class Self, class F>
  static void visit(Self& particles, F&& f) {
    auto& [positions, velocities, pressures, densities, types, ids] = particles;
    f("x", positions);
    f("v", velocities);
    f("pressure", pressures);
    f("density", densities);
    f("type", types);
    f("id", ids);
  }
};

}  // namespace surge
