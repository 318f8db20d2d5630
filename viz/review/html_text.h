#pragma once

#include <map>
#include <string>
#include <string_view>

namespace telestrain::viz {

// Texts from sessions are not trusted: whatever they hold stays text on the page.

// For element content and quoted attribute values.
std::string HtmlText(std::string_view text);

// The same script for a <script> element, which `</script` in a string would end.
std::string ScriptText(std::string_view script);
// The same JSON for a <script> element.
std::string JsonInScript(std::string_view json);

// RFC 4648, padded, without line ends.
std::string Base64(std::string_view bytes);

// "'sha256-…'": what Content-Security-Policy calls a script that may run.
std::string PolicyHash(std::string_view script);

// Replaces every {{name}} of the template; what is put in is not looked at again. A name without a
// text is a broken contract.
std::string Filled(std::string_view page, const std::map<std::string, std::string>& texts);

}  // namespace telestrain::viz
