#include "session/toml_fields.h"

#include <algorithm>
#include <cmath>

#include "base/numbers.h"

namespace telestrain {
namespace {

using Kind = TomlNode::Kind;

constexpr double kLongestCoordinate_mm = 1e6;
constexpr double kUnitTolerance = 0.02;  // "0.866, 0.5" and coarser roundings
// Below this a vector is a unit vector to rounding; normalising it again could change its last bit.
constexpr double kUnitRounding = 1e-12;

bool IsNumber(const TomlNode& node) {
  return (node.kind == Kind::kInteger || node.kind == Kind::kFloat) && std::isfinite(node.number);
}

// Also line ends: the texts stand in tables and file names.
bool HasControls(const std::string& text) {
  return std::any_of(text.begin(), text.end(),
                     [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; });
}

std::string NameOf(const TomlNode& table) {
  return table.path.empty() ? "the file" : "[" + table.path + "]";
}

Result<Eigen::Vector3d> ReadVector3(const TomlNode& node, const std::string& wanted) {
  if (node.kind != Kind::kArray || node.children.size() != 3) return WrongValue(node, wanted);
  Eigen::Vector3d vector;
  for (int i = 0; i < 3; ++i) {
    const TomlNode& item = node.children[static_cast<std::size_t>(i)];
    if (!IsNumber(item) || std::abs(item.number) > kLongestCoordinate_mm)
      return WrongValue(item, "a number between -1e6 and 1e6");
    vector[i] = item.number;
  }
  return vector;
}

Result<Eigen::Vector3d> ReadDirection(const TomlNode& node, const std::string& wanted) {
  TELESTRAIN_ASSIGN_OR_RETURN(const Eigen::Vector3d vector, ReadVector3(node, wanted));
  const double length = vector.norm();
  if (std::abs(length - 1) > kUnitTolerance)
    return BadInput(node.place + node.path + " has the length " + FormatFixed(length, 4) +
                    ", wanted 1 within 2 %; divide the vector by its length");
  if (std::abs(length - 1) < kUnitRounding) return vector;
  return Eigen::Vector3d(vector / length);
}

template <typename Into>
FieldReader NumberReader(Into& into, const NumberRange& range) {
  const std::string wanted = "a number " + range.Words();
  return {wanted, [&into, range, wanted](const TomlNode& node) -> Status {
            if (!IsNumber(node) || !range.Contains(node.number)) return WrongValue(node, wanted);
            into = node.number;
            return {};
          }};
}

template <typename Into>
FieldReader PointReader(Into& into) {
  const std::string wanted = "three numbers [x, y, z] in mm";
  return {wanted, [&into, wanted](const TomlNode& node) -> Status {
            TELESTRAIN_ASSIGN_OR_RETURN(into, ReadVector3(node, wanted));
            return {};
          }};
}

template <typename Into>
FieldReader DirectionReader(Into& into) {
  const std::string wanted = "a unit vector [x, y, z]";
  return {wanted, [&into, wanted](const TomlNode& node) -> Status {
            TELESTRAIN_ASSIGN_OR_RETURN(into, ReadDirection(node, wanted));
            return {};
          }};
}

Status CheckKnown(const TomlNode& table, const std::vector<TomlField>& fields) {
  std::vector<std::string> known;
  for (const TomlField& field : fields) known.push_back(field.key);
  for (const TomlNode& child : table.children) {
    if (std::find(known.begin(), known.end(), child.key) != known.end()) continue;
    return BadInput(child.place + "unknown key '" + child.key + "' in " + NameOf(table) +
                    "; the nearest known key is '" + NearestWord(child.key, known) +
                    "': rename or remove it");
  }
  return {};
}

}  // namespace

std::string NumberRange::Words() const {
  return (above_min ? "above " : "from ") + FormatShortest(min) +
         (above_min ? " and up to " : " to ") + FormatShortest(max);
}

Error WrongValue(const TomlNode& node, const std::string& wanted) {
  return BadInput(node.place + node.path + " is " + node.Shown() + ", wanted " + wanted +
                  "; correct the value");
}

FieldReader Number(double& into, NumberRange range) { return NumberReader(into, range); }
FieldReader Number(std::optional<double>& into, NumberRange range) {
  return NumberReader(into, range);
}

FieldReader Whole(int& into, NumberRange range) {
  const std::string wanted = "a whole number " + range.Words();
  return {wanted, [&into, range, wanted](const TomlNode& node) -> Status {
            if (node.kind != Kind::kInteger || !range.Contains(node.number))
              return WrongValue(node, wanted);
            into = static_cast<int>(node.number);
            return {};
          }};
}

FieldReader Text(std::string& into) {
  const std::string wanted = "a text of one line without control characters that is not empty";
  return {wanted, [&into, wanted](const TomlNode& node) -> Status {
            if (node.kind != Kind::kText || node.text.empty() || HasControls(node.text))
              return WrongValue(node, wanted);
            into = node.text;
            return {};
          }};
}

FieldReader OneOf(int& index_into, std::vector<std::string> choices) {
  std::string wanted = "one of";
  for (const std::string& choice : choices) wanted += " '" + choice + "'";
  return {wanted, [&index_into, choices, wanted](const TomlNode& node) -> Status {
            const auto at = std::find(choices.begin(), choices.end(), node.text);
            if (node.kind != Kind::kText || at == choices.end()) return WrongValue(node, wanted);
            index_into = static_cast<int>(at - choices.begin());
            return {};
          }};
}

FieldReader Point(Eigen::Vector3d& into) { return PointReader(into); }
FieldReader Point(std::optional<Eigen::Vector3d>& into) { return PointReader(into); }
FieldReader Direction(Eigen::Vector3d& into) { return DirectionReader(into); }
FieldReader Direction(std::optional<Eigen::Vector3d>& into) { return DirectionReader(into); }

FieldReader Wholes4(Eigen::Vector4i& into, NumberRange range) {
  const std::string wanted = "four whole numbers [x, y, width, height]";
  return {wanted, [&into, range, wanted](const TomlNode& node) -> Status {
            if (node.kind != Kind::kArray || node.children.size() != 4)
              return WrongValue(node, wanted);
            for (int i = 0; i < 4; ++i) {
              const TomlNode& item = node.children[static_cast<std::size_t>(i)];
              TELESTRAIN_RETURN_IF_ERROR(Whole(into[i], range).read(item));
            }
            return {};
          }};
}

FieldReader Table(std::vector<TomlField> fields) {
  std::string wanted = "a table with";
  for (const TomlField& field : fields)
    if (field.required) wanted.append(wanted.ends_with("with") ? " " : ", ").append(field.key);
  return {wanted, [fields = std::move(fields)](const TomlNode& node) -> Status {
            if (node.kind != Kind::kTable) return WrongValue(node, "a table [" + node.path + "]");
            return ReadFields(node, fields);
          }};
}

FieldReader Tables(std::string example, std::function<Status(const TomlNode&)> read_item) {
  const std::string wanted = "one or more tables " + example;
  return {wanted, [wanted, read_item = std::move(read_item)](const TomlNode& node) -> Status {
            if (node.kind != Kind::kArray) return WrongValue(node, wanted);
            for (const TomlNode& item : node.children) {
              if (item.kind != Kind::kTable) return WrongValue(item, wanted);
              TELESTRAIN_RETURN_IF_ERROR(read_item(item));
            }
            return {};
          }};
}

Status ReadFields(const TomlNode& table, const std::vector<TomlField>& fields) {
  TELESTRAIN_RETURN_IF_ERROR(CheckKnown(table, fields));
  for (const TomlField& field : fields) {
    const TomlNode* node = table.Find(field.key);
    if (node) {
      TELESTRAIN_RETURN_IF_ERROR(field.reader.read(*node));
    } else if (field.required) {
      return BadInput(table.place + "the key '" + field.key + "' is missing in " + NameOf(table) +
                      "; add it: " + field.reader.wanted);
    }
  }
  return {};
}

}  // namespace telestrain
