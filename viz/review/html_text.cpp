#include "viz/review/html_text.h"

#include <algorithm>
#include <cstdint>

#include "base/check.h"
#include "base/files.h"

namespace telestrain::viz {
namespace {

std::string Replaced(std::string_view text, std::string_view from, std::string_view to) {
  std::string result;
  std::size_t begin = 0;
  for (std::size_t at = text.find(from); at != std::string_view::npos;
       at = text.find(from, begin)) {
    result.append(text.substr(begin, at - begin)).append(to);
    begin = at + from.size();
  }
  return result.append(text.substr(begin));
}

unsigned HexDigit(char letter) {
  return static_cast<unsigned>(letter <= '9' ? letter - '0' : letter - 'a' + 10);
}

}  // namespace

std::string HtmlText(std::string_view text) {
  std::string result;
  for (const char letter : text) switch (letter) {
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
        result += letter;
    }
  return result;
}

std::string ScriptText(std::string_view script) {
  // Inside literals, the only place where these occur in a valid script, the backslash is void.
  return Replaced(Replaced(script, "<!--", "<\\!--"), "</script", "<\\/script");
}

std::string JsonInScript(std::string_view json) { return Replaced(json, "<", "\\u003c"); }

std::string Base64(std::string_view bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
    std::uint32_t group = 0;
    for (std::size_t i = 0; i < 3; ++i)
      group = group << 8 | (i < count ? static_cast<unsigned char>(bytes[at + i]) : 0u);
    for (std::size_t i = 0; i < 4; ++i)
      text += i <= count ? kDigits[group >> (18 - 6 * i) & 63u] : '=';
  }
  return text;
}

std::string PolicyHash(std::string_view script) {
  const std::string hex = Sha256Hex(script);
  std::string bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2)
    bytes += static_cast<char>(HexDigit(hex[i]) << 4 | HexDigit(hex[i + 1]));
  return "'sha256-" + Base64(bytes) + "'";
}

std::string Filled(std::string_view page, const std::map<std::string, std::string>& texts) {
  std::string result;
  std::size_t begin = 0;
  for (std::size_t at = page.find("{{"); at != std::string_view::npos;
       at = page.find("{{", begin)) {
    const std::size_t end = page.find("}}", at);
    TELESTRAIN_CHECK(end != std::string_view::npos, "a {{name}} of the page has no end");
    const auto text = texts.find(std::string(page.substr(at + 2, end - at - 2)));
    TELESTRAIN_CHECK(text != texts.end(), "a {{name}} of the page is unknown");
    result.append(page.substr(begin, at - begin)).append(text->second);
    begin = end + 2;
  }
  return result.append(page.substr(begin));
}

}  // namespace telestrain::viz
