#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "compare/figures/gnuplot.hpp"
#include "compare/study/study_result.hpp"

namespace surge::compare {

/// Figures that stand in a section of their own: name, what it is called, where it stands.
[[nodiscard]] std::span<const std::array<const char*, 3>> figures_elsewhere();

/// Writes out/index.html, one file that needs no other, from the templates in page/ and the numbers
/// of metrics.json; `figures` are drawn already, below out/figures. The templates are Jinja2's, so
/// that Python does the work. Throws Error with the template and line where one cannot be filled.
void write_page(const StudyResult& study, const nlohmann::json& metrics,
                const std::vector<Figure>& figures, const std::filesystem::path& out);

/// Files of page/ by their names, built into the program.
[[nodiscard]] std::span<const std::pair<std::string_view, std::string_view>> page_files();

}  // namespace surge::compare
