#include "compare/read/foam_field.hpp"

#include "compare/read/foam_dictionary.hpp"
#include "compare/read/foam_file.hpp"

namespace surge::compare {
namespace {

/// Goes past a dictionary whose `{` is next. No recursion: braces may nest as deep as they like.
void skip_dictionary(FoamCursor& cursor, const FoamHeader& header) {
  cursor.expect("{");
  std::size_t depth = 1;
  while (depth > 0) {
    if (cursor.at_end()) cursor.cut_short("its { } do");
    const std::string_view key = cursor.token();
    if (key == "}") {
      --depth;
    } else if (key.starts_with("#")) {
      (void)cursor.token();
    } else if (key != ";") {
      if (cursor.peek() == '{') {
        cursor.expect("{");
        ++depth;
      } else {
        cursor.skip_value(header);
      }
    }
  }
}

std::vector<std::string> patch_names(FoamCursor& cursor, const FoamHeader& header) {
  std::vector<std::string> names;
  cursor.expect("{");
  while (cursor.peek() != '}') {
    if (cursor.at_end()) cursor.cut_short("its boundaryField does");
    const std::string_view key = cursor.token();
    if (key.starts_with("#")) {
      (void)cursor.token();
    } else if (cursor.peek() == '{') {
      names.emplace_back(key);
      skip_dictionary(cursor, header);
    } else {
      cursor.skip_value(header);
    }
  }
  cursor.expect("}");
  return names;
}

void repeat(std::vector<double>& values, std::size_t count) {
  const std::vector<double> one = values;
  values.reserve(one.size() * count);
  for (std::size_t i = 1; i < count; ++i) values.insert(values.end(), one.begin(), one.end());
  if (count == 0) values.clear();
}

/// `uniform 0`, `uniform (0 0 0)`; false where it is a macro.
bool read_uniform(FoamCursor& cursor, std::size_t components, std::vector<double>& values) {
  if (cursor.peek() == '$' || cursor.peek() == '#') return false;
  if (components > 1) cursor.expect("(");
  for (std::size_t k = 0; k < components; ++k) {
    if (cursor.peek() == '$') return false;
    values.push_back(cursor.number());
  }
  if (components > 1) cursor.expect(")");
  return true;
}

}  // namespace

FoamField read_foam_field(const FoamBlock& block, const std::string& place,
                          const std::filesystem::path& root, std::size_t components,
                          std::size_t cells) {
  FoamCursor cursor(block.text, place);
  const FoamHeader header = cursor.header(block.header);
  const std::string expected = components == 1 ? "volScalarField" : "volVectorField";
  if (!header.type.empty() && header.type != expected)
    cursor.fail("class " + header.type + " found, " + expected + " expected");
  FoamField field;
  field.location = header.location;
  bool has_values = false, has_patches = false;
  while (!cursor.at_end()) {
    const std::string key(cursor.token());
    if (key.starts_with("#")) {
      (void)cursor.token();
    } else if (key == "internalField") {
      if (has_values) cursor.fail("a second internalField found, one expected");
      has_values = true;
      const std::string kind(cursor.token());
      if (kind == "uniform") {
        if (!read_uniform(cursor, components, field.values)) {
          field.values = FoamDictionary::parse(std::string(block.text), place, root)
                             .numbers("internalField", components);
          cursor.skip_value(header);
          repeat(field.values, cells);
          continue;
        }
        repeat(field.values, cells);
      } else if (kind == "nonuniform") {
        if (cursor.peek() == 'L') {
          const std::string list(cursor.token());
          const std::string wanted = components == 1 ? "List<scalar>" : "List<vector>";
          if (list != wanted) cursor.fail(list + " found, " + wanted + " expected");
        }
        field.values = cursor.scalars(header, components);
      } else {
        if (kind.empty()) cursor.cut_short("its internalField does");
        cursor.fail(kind.substr(0, 40) + " found, uniform or nonuniform expected");
      }
      cursor.expect(";");
    } else if (key == "boundaryField") {
      field.patches = patch_names(cursor, header);
      has_patches = true;
    } else if (cursor.peek() == '{') {
      skip_dictionary(cursor, header);
    } else if (key != ";") {
      cursor.skip_value(header);
    }
  }
  if (!has_values) cursor.cut_short("its internalField");
  if (!has_patches) cursor.cut_short("its boundaryField");
  if (field.values.size() != cells * components) {
    cursor.fail(std::to_string(field.values.size() / components) + " values found, " +
                std::to_string(cells) + " cells expected");
  }
  return field;
}

}  // namespace surge::compare
