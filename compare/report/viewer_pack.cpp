#include "compare/report/viewer_pack.hpp"

#include <vtkBase64Utilities.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>

#include "particle/support/error.hpp"

namespace surge::compare {

namespace {

/// So that twice the difference of two still fits into 32 bits.
constexpr double most_steps = 1 << 29;

std::vector<std::uint8_t> deflated(const std::vector<std::uint8_t>& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<std::uint8_t> out(size);
  if (compress2(out.data(), &size, bytes.data(), static_cast<uLong>(bytes.size()),
                Z_BEST_COMPRESSION) != Z_OK)
    throw Error("the viewer's data could not be compressed: out of memory");
  out.resize(size);
  return out;
}

}  // namespace

std::int32_t steps_of(double value, double step) {
  const double steps = std::round(value / step);
  if (std::isnan(steps)) return 0;
  return static_cast<std::int32_t>(std::clamp(steps, -most_steps, most_steps));
}

std::uint8_t quantise_unit(double value) {
  return std::isnan(value)
             ? std::uint8_t{0}
             : static_cast<std::uint8_t>(std::round(255.0 * std::clamp(value, 0.0, 1.0)));
}

std::string base64(std::span<const std::uint8_t> bytes) {
  std::string text((bytes.size() + 2) / 3 * 4, '=');
  // VTK writes into unsigned characters.
  const auto length = vtkBase64Utilities::Encode(bytes.data(), bytes.size(),
                                                 reinterpret_cast<unsigned char*>(text.data()));
  text.resize(length);
  return text;
}

void ByteStream::number(std::uint32_t value) {
  for (; value >= 0x80U; value >>= 7U)
    bytes_.push_back(static_cast<std::uint8_t>((value & 0x7fU) | 0x80U));
  bytes_.push_back(static_cast<std::uint8_t>(value));
}

void ByteStream::signed_number(std::int32_t value) {
  const auto bits = static_cast<std::uint32_t>(value);
  number(value < 0 ? ~(bits << 1U) : bits << 1U);
}

nlohmann::json packed(const std::vector<const ByteStream*>& streams) {
  std::vector<std::uint8_t> bytes;
  nlohmann::json sizes = nlohmann::json::array();
  for (const ByteStream* stream : streams) {
    sizes.push_back(stream->bytes().size());
    bytes.insert(bytes.end(), stream->bytes().begin(), stream->bytes().end());
  }
  return {{"sizes", sizes}, {"data", base64(deflated(bytes))}};
}

}  // namespace surge::compare
