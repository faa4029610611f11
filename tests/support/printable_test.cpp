#include "particle/support/printable.hpp"

#include <gtest/gtest.h>

namespace surge {
namespace {

TEST(Printable, ControlCharactersAreNotObeyed) {
  EXPECT_EQ(printable("a\x1b[31mb\x07\x7f\n"), "a?[31mb???");
  EXPECT_EQ(printable_lines("a\x1b\nb\r"), "a?\nb?");
  // U+009B begins a command as ESC [ does; so do its neighbours up to U+009F.
  EXPECT_EQ(printable("a\xc2\x9b"
                      "31m\xc2\x80"),
            "a??31m??");
}

TEST(Printable, LettersOfAllLanguagesStay) {
  const std::string text =
      "gr\xc3\xb6\xc3\x9f"
      "e \xc2\xa0\xc2\xb5m \xe6\xb3\xa2 \xf0\x9f\x8c\x8a";
  EXPECT_EQ(printable(text), text);
}

}  // namespace
}  // namespace surge
