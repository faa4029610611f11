#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "compare/figures/image.hpp"
#include "particle/support/table.hpp"

namespace surge::compare {

/// Widths of a journal's columns.
inline constexpr double single_column_mm = 84.0;
inline constexpr double double_column_mm = 174.0;

/// A curve of a figure for a page that draws it again: the rows of a table whose first entry is
/// `key`, in their order.
struct PlottedCurve {
  std::string table, key;
  std::string x, y;  ///< columns
  std::string label;
  std::string colour;   ///< #rrggbb
  bool points = false;  ///< markers without a line
};

/// A figure before it is drawn. The script holds only what is particular to it: terminal, fonts,
/// axes and grid come from draw(), so that all figures look alike.
struct Figure {
  std::string name;     ///< file stem, such as fig8
  std::string title;    ///< heading, such as "Fig. 8. Motion of the leading edge"
  std::string caption;  ///< what the reader has to know, plain text
  double width_mm = single_column_mm;
  double height_mm = 70.0;
  std::string script;         ///< gnuplot commands; data files are named relative to the folder
  std::vector<Table> tables;  ///< written as CSV before gnuplot runs
  std::vector<NamedImage> images;  ///< written as PNG before gnuplot runs
  /// Why there is nothing to draw; then no file is written.
  std::string missing{};
  /// What a reader can look at closely, with the words at its axes; empty where there is no such.
  std::vector<PlottedCurve> curves{};
  std::string x_label{}, y_label{};
};

/// Writes NAME.gp, NAME.svg, NAME.pdf and the tables into the folder. `gnuplot NAME.gp` there
/// draws it again. Returns gnuplot's warnings, empty where there are none; throws Error with its
/// message where it fails or is not installed. Of a figure with nothing to draw no file is written.
[[nodiscard]] std::string draw(const Figure& figure, const std::filesystem::path& folder);

/// The same for several figures, as many at a time as there are cores; warnings in their order.
[[nodiscard]] std::vector<std::string> draw_all(std::span<const Figure> figures,
                                                const std::filesystem::path& folder);

/// `"NAME.csv" every ::A::B`, for `plot`: the rows of the table that begin with these cells, the
/// first that stand together; empty where there are none. gnuplot passes over all others. An
/// expression that picks rows is evaluated for each row of the file, which for the free surfaces of
/// a study took two thirds of the time of all figures.
[[nodiscard]] std::string plotted_rows(const Table& table, const std::vector<Table::Cell>& key);

/// Text as a gnuplot string in double quotes, characters as they are.
[[nodiscard]] std::string plot_string(const std::string& text);
/// The same for `set label`, whose text would otherwise be read as markup.
[[nodiscard]] std::string plot_label(const std::string& text);

}  // namespace surge::compare
