#pragma once

#include "compare/read/packer.hpp"
#include "compare/read/particle_table.hpp"

namespace surge::compare {

void put_table(Packer& out, const ParticleTable& table);
[[nodiscard]] ParticleTable get_table(Unpacker& in);

}  // namespace surge::compare
