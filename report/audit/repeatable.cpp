#include "report/audit/repeatable.h"

#include <algorithm>

#include "report/audit/trail_files.h"

namespace telestrain {
namespace {

// A value that a command line would take for another option.
bool IsFlag(const Json& value) {
  return value.is_string() && value.get_ref<const std::string&>().starts_with("-");
}

bool IsOneOption(const std::string& name, const Json& value) {
  constexpr const char* kOfNames = "abcdefghijklmnopqrstuvwxyz0123456789-";
  return name.find_first_not_of(kOfNames) == std::string::npos &&
         !(value.is_array() && std::any_of(value.begin(), value.end(), IsFlag));
}

Status CheckOption(const std::string& line, const std::string& name, const Json& value) {
  const bool is_place =
      std::find(kWritingOptions.begin(), kWritingOptions.end(), name) != kWritingOptions.end();
  if (!IsOneOption(name, value) || (is_place && !value.is_null() && !value.is_string()))
    return BadInput(line + " of the audit trail cannot be repeated: its option '" + name +
                    "' is not as telestrain records it");
  if (!is_place || value.is_null() || value == "" || LiesInside(value.get<std::string>()))
    return {};
  return BadInput(line + " of the audit trail cannot be repeated: it wrote to '" +
                  value.get<std::string>() + "', which is no path inside the folder");
}

}  // namespace

Status CheckRepeatable(const std::vector<AuditEntry>& entries) {
  TELESTRAIN_RETURN_IF_ERROR(CheckPaths(entries));
  for (std::size_t i = 0; i < entries.size(); ++i)
    for (const auto& [name, value] : EntryAt(entries[i].body, "/options").items())
      TELESTRAIN_RETURN_IF_ERROR(CheckOption(LineName(entries, i), name, value));
  return {};
}

}  // namespace telestrain
