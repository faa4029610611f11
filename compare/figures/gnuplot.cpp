#include "compare/figures/gnuplot.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <fstream>
#include <sstream>
#include <thread>

#include "particle/support/error.hpp"
#include "particle/support/process.hpp"
#include "particle/support/write_error.hpp"

namespace surge::compare {

namespace fs = std::filesystem;

namespace {

/// Terminals and style. Text is 7 pt in both files, readable at the printed width: 9.3 px of 1/96
/// inch, and pdfcairo takes its points for 1/54 inch.
std::string preamble(const Figure& figure) {
  const auto pixels = [](double mm) { return std::to_string(std::lround(mm / 25.4 * 96.0)); };
  const auto cm = [](double mm) { return fixed_text(mm / 10.0, 2) + "cm"; };
  std::ostringstream out;
  out << "# " << plot_string(figure.title) << "\n# Draws " << figure.name << ".svg and "
      << figure.name << ".pdf again: gnuplot " << figure.name << ".gp\n"
      << "do for [kind in \"svg pdf\"] {\n"
      << "if (kind eq \"svg\") { set terminal svg enhanced size " << pixels(figure.width_mm) << ','
      << pixels(figure.height_mm) << " font \"sans-serif,9.3\" background rgb \"white\" name \""
      << figure.name << "\" } else { set terminal pdfcairo enhanced color size "
      << cm(figure.width_mm) << ',' << cm(figure.height_mm)
      << " font \"Sans,7\" linewidth 1.8 fontscale 0.75 }\n"
      << "set output \"" << figure.name << ".\".kind\n"
      << R"(set encoding utf8
set datafile separator comma
set datafile columnheaders
set border 3 lw 0.8 lc rgb "#404040"
set tics nomirror out scale 0.5 textcolor rgb "#202020"
set grid lt 1 lw 0.4 lc rgb "#e4e4e4"
set key samplen 2.2 spacing 1.05 noenhanced textcolor rgb "#202020"
set bars 0.4
)";
  return out.str();
}

/// All that gnuplot reads of a figure.
void write_inputs(const Figure& figure, const fs::path& folder) {
  fs::create_directories(folder);
  for (const auto& table : figure.tables) write_csv(table, folder);
  for (const auto& [name, image] : figure.images) image.write_png(folder / (name + ".png"));
  const std::string script = figure.name + ".gp";
  std::ofstream out(folder / script);
  out << preamble(figure) << figure.script << "\nunset output\nreset session\n}\n";
  out.close();
  if (!out) throw write_error(folder / script);
}

std::string run_gnuplot(const Figure& figure, const fs::path& folder) {
  const std::string script = figure.name + ".gp";
  const auto [status, said] = run_process("gnuplot", {script}, folder, "gnuplot-nox");
  if (status != 0) throw Error((folder / script).string() + ": gnuplot failed: " + said);
  return said;
}

}  // namespace

std::string draw(const Figure& figure, const fs::path& folder) {
  return draw_all({&figure, 1}, folder).front();
}

std::vector<std::string> draw_all(std::span<const Figure> figures, const fs::path& folder) {
  for (const Figure& figure : figures)
    if (figure.missing.empty()) write_inputs(figure, folder);
  std::vector<std::string> said(figures.size());
  std::vector<std::exception_ptr> failed(figures.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < figures.size(); i = next++) {
      try {
        if (figures[i].missing.empty()) said[i] = run_gnuplot(figures[i], folder);
      } catch (...) {
        failed[i] = std::current_exception();
      }
    }
  };
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  {
    std::vector<std::jthread> helpers;
    for (std::size_t k = 1; k < std::min(cores, figures.size()); ++k) helpers.emplace_back(work);
    work();
  }
  for (const std::exception_ptr& failure : failed)
    if (failure) std::rethrow_exception(failure);
  return said;
}

std::string plotted_rows(const Table& table, const std::vector<Table::Cell>& key) {
  const auto begins_so = [&](const std::vector<Table::Cell>& row) {
    return row.size() >= key.size() && std::equal(key.begin(), key.end(), row.begin());
  };
  const auto first = std::find_if(table.rows.begin(), table.rows.end(), begins_so);
  if (first == table.rows.end()) return "";
  const auto end = std::find_if_not(first, table.rows.end(), begins_so);
  return '"' + table.name + ".csv\" every ::" + std::to_string(first - table.rows.begin()) +
         "::" + std::to_string(end - table.rows.begin() - 1);
}

// gnuplot runs what stands between backquotes, in double quotes too; the octal code is a backquote
// that runs nothing. Other control characters than line breaks have no place in a label.
std::string plot_string(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\n') {
      result += "\\n";
    } else if (c == '"' || c == '\\') {
      result += std::string("\\") + c;
    } else if (c == '`') {
      result += "\\140";
    } else if (static_cast<unsigned char>(c) >= ' ' && c != '\x7f') {
      result += c;
    }
  }
  return '"' + result + '"';
}

std::string plot_label(const std::string& text) {
  return plot_string(text) + " noenhanced";
}

}  // namespace surge::compare
