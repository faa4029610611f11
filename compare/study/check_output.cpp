#include "compare/study/check_output.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>

#include "particle/support/bounds.hpp"

namespace surge::compare {
namespace {

std::string short_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return std::isfinite(value) ? text : "-";
}

/// Columns as wide as what stands in them.
void write_columns(std::ostream& out, const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const auto& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t k = 0; k < row.size(); ++k) {
      line += row[k];
      if (k + 1 < row.size()) line.append(widths[k] - row[k].size() + 2, ' ');
    }
    out << line << '\n';
  }
}

/// Bytes of the UTF-8 character at a place; 0 where there is none that XML 1.0 may hold.
std::size_t character_length(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0U;
  };
  const unsigned lead = byte(0);
  if (lead < 0x80) return lead >= 0x20 && lead != 0x7f ? 1 : lead == '\n' || lead == '\t' ? 1 : 0;
  const std::size_t length = lead >= 0xf5   ? 0
                             : lead >= 0xf0 ? 4
                             : lead >= 0xe0 ? 3
                             : lead >= 0xc2 ? 2
                                            : 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0U) != 0x80) return 0;
  // Overlong forms, surrogates, what lies beyond U+10FFFF, and the two that are no characters.
  if (lead == 0xe0 && byte(1) < 0xa0) return 0;
  if (lead == 0xed && byte(1) >= 0xa0) return 0;
  if (lead == 0xf0 && byte(1) < 0x90) return 0;
  if (lead == 0xf4 && byte(1) >= 0x90) return 0;
  if (lead == 0xef && byte(1) == 0xbf && byte(2) >= 0xbe) return 0;
  return length;
}

std::string xml_text(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = character_length(text, at);
    const char c = text[at];
    if (length == 0) {
      out += '?';
    } else if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else if (c == '\n') {
      out += "&#10;";
    } else if (c == '\t') {
      out += "&#9;";
    } else {
      out.append(text, at, length);
    }
    at += std::max<std::size_t>(length, 1);
  }
  return out;
}

std::string sentence(const Finding& f) {
  std::string text = "found " + f.found + ", expected " + f.expected;
  if (f.tolerance > 0.0) text += " within " + short_text(f.tolerance);
  if (!f.unit.empty() && f.unit != "1") text += ' ' + f.unit;
  if (!f.worst.empty()) text += " at " + f.worst;
  if (!f.why.empty()) text += ": " + f.why;
  return text;
}

void write_case(std::ostream& out, const CheckReport& report, const Finding& f) {
  out << "    <testcase classname=\"" << xml_text(report.source) << "\" name=\""
      << xml_text(f.quantity) << '"';
  if (f.status == Status::passed) {
    out << "/>\n";
  } else if (f.status == Status::skipped) {
    out << ">\n      <skipped/>\n    </testcase>\n";
  } else {
    out << ">\n      <failure message=\"" << xml_text(sentence(f)) << "\"/>\n    </testcase>\n";
  }
}

}  // namespace

bool CheckReport::passed() const {
  return error.empty() && !findings.empty() && failed() == 0;
}

std::size_t CheckReport::failed() const {
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(),
                    [](const Finding& f) { return f.status == Status::failed; }));
}

void write_table(std::ostream& out, const CheckReport& report) {
  std::vector<std::vector<std::string>> rows{
      {"quantity", "status", "worst at", "found", "expected", "unit", "deviation", "tolerance"}};
  const auto dash = [](const std::string& text) { return text.empty() ? "-" : text; };
  for (const Finding& f : report.findings)
    rows.push_back({f.quantity, status_text(f.status), dash(f.worst), dash(f.found),
                    dash(f.expected), dash(f.unit), short_text(f.deviation),
                    short_text(f.tolerance)});
  write_columns(out, rows);
  for (const Finding& f : report.findings)
    if (!f.why.empty()) out << f.quantity << ": " << f.why << '\n';
  if (!report.window.empty()) out << "window: " << report.window << '\n';
  out << report.source << ": " << (report.passed() ? "passed" : "failed") << " (" << report.failed()
      << " of " << report.findings.size() << " quantities outside " << report.against << ")\n";
}

void write_junit(std::ostream& out, const std::vector<CheckReport>& reports) {
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
  for (const CheckReport& report : reports) {
    const bool error = !report.error.empty() || report.findings.empty();
    out << "  <testsuite name=\"surge-compare " << xml_text(report.source) << " against "
        << xml_text(report.against) << "\" tests=\"" << report.findings.size() + (error ? 1 : 0)
        << "\" failures=\"" << report.failed() << "\" errors=\"" << (error ? 1 : 0) << "\">\n";
    for (const Finding& finding : report.findings) write_case(out, report, finding);
    if (error)
      out << "    <testcase classname=\"" << xml_text(report.source)
          << "\" name=\"source\">\n      <error message=\""
          << xml_text(report.error.empty() ? "nothing was compared" : report.error)
          << "\"/>\n    </testcase>\n";
    out << "  </testsuite>\n";
  }
  out << "</testsuites>\n";
}

nlohmann::json to_json(const CheckReport& report) {
  nlohmann::json findings = nlohmann::json::array();
  for (const Finding& f : report.findings) {
    nlohmann::json entry{
        {"quantity", f.quantity}, {"status", status_text(f.status)}, {"worst", f.worst},
        {"found", f.found},       {"expected", f.expected},          {"unit", f.unit},
        {"deviation", nullptr},   {"tolerance", f.tolerance},        {"why", f.why}};
    if (std::isfinite(f.deviation)) entry["deviation"] = f.deviation;
    findings.push_back(std::move(entry));
  }
  return {{"source", report.source},  {"against", report.against}, {"passed", report.passed()},
          {"error", report.error},    {"window", report.window},   {"findings", findings},
          {"notices", report.notices}};
}

}  // namespace surge::compare
