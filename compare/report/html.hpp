#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace surge::compare {

/// Text with & < > " ' made harmless, for elements and attributes alike.
[[nodiscard]] std::string escape(const std::string& text);

/// "/front/vof-20/rms_vs_vof" from its parts: a JSON pointer (RFC 6901).
[[nodiscard]] std::string key(const std::vector<std::string>& parts);

/// Puts values of metrics.json on the page, and nothing else: each is an element
/// `<data data-key="POINTER" value="FULL">SHOWN</data>`, so that a reader, and a test, can find
/// where it comes from. A pointer that leads nowhere is a mistake in the report and throws
/// std::logic_error; null is shown as an en dash.
class Values {
 public:
  explicit Values(const nlohmann::json& metrics) : metrics_(&metrics) {}

  [[nodiscard]] const nlohmann::json& at(const std::string& pointer) const;
  [[nodiscard]] bool has(const std::string& pointer) const;
  [[nodiscard]] std::string number(const std::string& pointer, int decimals) const;
  [[nodiscard]] std::string integer(const std::string& pointer) const { return number(pointer, 0); }
  /// To three significant digits, for quantities of any size.
  [[nodiscard]] std::string magnitude(const std::string& pointer) const;
  /// With its sign, + or −.
  [[nodiscard]] std::string signed_number(const std::string& pointer, int decimals) const;
  /// Words, or any other value as it is written in JSON.
  [[nodiscard]] std::string text(const std::string& pointer) const;

 private:
  [[nodiscard]] std::string element(const std::string& pointer, const std::string& shown) const;

  const nlohmann::json* metrics_;
};

/// Cells are HTML. The first column is a row's heading. Scrolls by itself in a narrow window.
[[nodiscard]] std::string html_table(const std::string& caption,
                                     const std::vector<std::string>& header,
                                     const std::vector<std::vector<std::string>>& rows);

/// The drawing of an SVG file as an element of the page: without its prologue, with the name
/// before each id, so that several drawings do not share one, and with a label for those who
/// cannot see it. Throws Error where the file is not an SVG.
[[nodiscard]] std::string inline_svg(const std::filesystem::path& file, const std::string& name,
                                     const std::string& label);

/// The whole page; `body` is HTML, `more_style` is CSS besides the page's own.
[[nodiscard]] std::string html_page(const std::string& title, const std::string& body,
                                    std::string_view more_style);

}  // namespace surge::compare
