#include "compare/report/html.hpp"

#include <cmath>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "particle/support/error.hpp"
#include "particle/support/table.hpp"

namespace surge::compare {

using nlohmann::json;

std::string escape(const std::string& text) {
  std::string result;
  for (char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string key(const std::vector<std::string>& parts) {
  json::json_pointer pointer;
  for (const auto& part : parts) pointer /= part;
  return pointer.to_string();
}

const json& Values::at(const std::string& pointer) const {
  const json::json_pointer path(pointer);
  if (!metrics_->contains(path)) throw std::logic_error("report: metrics have no " + pointer);
  return metrics_->at(path);
}

bool Values::has(const std::string& pointer) const {
  const json::json_pointer path(pointer);
  return metrics_->contains(path) && !metrics_->at(path).is_null();
}

std::string Values::element(const std::string& pointer, const std::string& shown) const {
  const json& value = at(pointer);
  const std::string full = value.is_string() ? value.get<std::string>() : value.dump();
  return "<data data-key=\"" + escape(pointer) + "\" value=\"" + escape(full) + "\">" +
         escape(shown) + "</data>";
}

std::string Values::number(const std::string& pointer, int decimals) const {
  const json& value = at(pointer);
  if (value.is_null()) return element(pointer, "–");
  const double x = value.get<double>();
  const std::string size = fixed_text(std::abs(x), decimals);
  const bool zero = size.find_first_not_of("0.") == std::string::npos;
  std::string shown = x < 0.0 && !zero ? "−" : "";
  shown += size;
  return element(pointer, shown);
}

std::string Values::magnitude(const std::string& pointer) const {
  const json& value = at(pointer);
  if (value.is_null()) return element(pointer, "–");
  const double x = std::abs(value.get<double>());
  const int before = x > 0.0 ? static_cast<int>(std::floor(std::log10(x))) + 1 : 1;
  return number(pointer, std::clamp(3 - before, 0, 12));
}

std::string Values::signed_number(const std::string& pointer, int decimals) const {
  const json& value = at(pointer);
  if (value.is_null() || value.get<double>() <= 0.0) return number(pointer, decimals);
  std::string shown = "+";
  shown += fixed_text(value.get<double>(), decimals);
  return element(pointer, shown);
}

std::string Values::text(const std::string& pointer) const {
  const json& value = at(pointer);
  if (value.is_null()) return element(pointer, "–");
  if (value.is_boolean()) return element(pointer, value.get<bool>() ? "yes" : "no");
  return element(pointer, value.is_string() ? value.get<std::string>() : value.dump());
}

std::string html_table(const std::string& caption, const std::vector<std::string>& header,
                       const std::vector<std::vector<std::string>>& rows) {
  std::string html = "<div class=\"scroll\" tabindex=\"0\">\n<table>\n<caption>" + caption +
                     "</caption>\n<thead><tr>";
  for (const auto& cell : header) html += "<th scope=\"col\">" + cell + "</th>";
  html += "</tr></thead>\n<tbody>\n";
  for (const auto& row : rows) {
    html += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) {
      html += i == 0 ? "<th scope=\"row\">" + row[i] + "</th>" : "<td>" + row[i] + "</td>";
    }
    html += "</tr>\n";
  }
  return html + "</tbody>\n</table>\n</div>\n";
}

std::string inline_svg(const std::filesystem::path& file, const std::string& name,
                       const std::string& label) {
  std::ifstream in(file);
  std::stringstream buffer;
  buffer << in.rdbuf();
  std::string svg = buffer.str();
  const auto start = svg.find("<svg");
  const auto end = svg.find('>', start);
  const auto close = svg.rfind("</svg>");
  if (!in || start == std::string::npos || close == std::string::npos) {
    throw Error(file.string() + ": no <svg> element, expected a drawing");
  }
  std::smatch box;
  const std::string head = svg.substr(start, end - start);
  if (!std::regex_search(head, box, std::regex(R"(viewBox="0 0 (\d+) (\d+)\")"))) {
    throw Error(file.string() + ": no viewBox, expected one");
  }
  std::string body = svg.substr(end + 1, close - end - 1);
  body = std::regex_replace(body, std::regex("<(title|desc)>[^<]*</(title|desc)>"), "");
  body = std::regex_replace(body, std::regex("\\bid=(['\"])"), "id=$1" + name + "-");
  body = std::regex_replace(body, std::regex("(href=['\"]|url\\()#"), "$1#" + name + "-");
  return "<svg viewBox=\"" + std::string("0 0 ") + box[1].str() + ' ' + box[2].str() +
         "\" xmlns=\"http://www.w3.org/2000/svg\" "
         "xmlns:xlink=\"http://www.w3.org/1999/xlink\" role=\"img\" aria-label=\"" +
         escape(label) + "\">" + body + "</svg>";
}

}  // namespace surge::compare
