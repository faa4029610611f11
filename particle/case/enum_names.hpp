#pragma once

#include "particle/case/case.hpp"
#include "particle/support/enum_names.hpp"

namespace surge {

template <>
inline constexpr std::array enum_names<FluidBlock::Shape>{Named{"box", FluidBlock::Shape::box},
                                                          Named{"ball", FluidBlock::Shape::ball}};
template <>
inline constexpr std::array enum_names<WallCondition>{Named{"slip", WallCondition::slip},
                                                      Named{"no-slip", WallCondition::no_slip}};

}  // namespace surge
