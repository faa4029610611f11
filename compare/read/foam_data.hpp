#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace surge::compare {

/// What the header `FoamFile { ... }` of a file says about the lists behind it.
struct FoamHeader {
  bool binary = false;
  int label_bytes = 4;     ///< of an integer in binary
  int scalar_bytes = 8;    ///< of a floating-point number in binary
  std::string type;        ///< entry `class`
  std::string inner_type;  ///< entry `data.class`, of the blocks in a file of the collated format
  std::string location;    ///< folder that it was written to; empty where not said
  std::string note;        ///< of a mesh file: its numbers of points, cells and faces
};

/// Reads OpenFOAM's lists in ascii and in binary. Every access is inside the text; what is
/// announced is compared with what is there before memory is asked for. Throws surge::Error with
/// file and line, FoamCutShort where the text ends early.
class FoamCursor {
 public:
  FoamCursor(std::string_view text, std::string place) : text_(text), place_(std::move(place)) {}

  /// The header, if the next entry is one; else `usual`.
  FoamHeader header(const FoamHeader& usual = {});

  void skip_blanks();
  [[nodiscard]] bool at_end();
  /// The next character that is not blank; '\0' at the end.
  [[nodiscard]] char peek();
  /// The next token: one of {}()[]; or a string in quotes (without them) or a word; empty at the
  /// end.
  std::string_view token();
  void expect(std::string_view token);
  double number();
  std::uint64_t count();
  /// Everything up to the `;` that ends an entry, lists in binary included.
  void skip_value(const FoamHeader& header);

  /// Lists `N (...)` or `N{value}`; `components` numbers to a value.
  std::vector<double> scalars(const FoamHeader& header, std::size_t components);
  std::vector<std::int64_t> labels(const FoamHeader& header);
  /// Bytes of a block `N (...)`.
  std::string_view bytes();

  [[noreturn]] void fail(const std::string& message) const;
  [[noreturn]] void cut_short(const std::string& what) const;

 private:
  /// The size before a list and how it goes on: '(' for its values, '{' for one that is repeated,
  /// '\0' for an empty list without brackets.
  struct ListStart {
    std::uint64_t size = 0;
    bool counted = true;
    char bracket = '\0';
  };
  ListStart list_start(std::size_t bytes_each);
  std::string_view raw(std::uint64_t bytes);
  void ascii_scalars(std::vector<double>& values, std::size_t components);

  std::string_view text_;
  std::string place_;
  std::size_t at_ = 0;
};

/// The texts of the processors in a file of the collated format (class decomposedBlockData), each
/// with the header that holds for it.
struct FoamBlock {
  std::string_view text;
  FoamHeader header;
};
[[nodiscard]] std::vector<FoamBlock> foam_blocks(std::string_view text, const std::string& place);

}  // namespace surge::compare
