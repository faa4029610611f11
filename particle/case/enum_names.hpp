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

template <>
inline constexpr std::array enum_names<TankMotion::Kind>{
    Named{"translation", TankMotion::Kind::translation},
    Named{"rotation", TankMotion::Kind::rotation}};
template <>
inline constexpr std::array enum_names<ScalarMotion::Kind>{
    Named{"harmonic", ScalarMotion::Kind::harmonic},
    Named{"constant", ScalarMotion::Kind::constant}, Named{"table", ScalarMotion::Kind::table}};
template <>
inline constexpr std::array enum_names<ScalarMotion::Quantity>{
    Named{"displacement", ScalarMotion::Quantity::displacement},
    Named{"acceleration", ScalarMotion::Quantity::acceleration}};

inline constexpr std::array<std::string_view, 6> side_names{"x-", "x+", "y-", "y+", "z-", "z+"};
inline constexpr std::array<std::string_view, 3> axis_names{"x", "y", "z"};

}  // namespace surge
