#include "viz/review/review_page.h"

#include <algorithm>
#include <map>
#include <optional>

#include "base/numbers.h"
#include "viz/review/html_text.h"
#include "viz/review/part_json.h"
#include "viz/review/result_tables.h"
#include "viz/review/results_shape.h"

// The files of this folder and vtk.js, as the assembler puts them into the program.
extern "C" {
extern const char telestrain_review_html[], telestrain_review_html_end[];
extern const char telestrain_review_css[], telestrain_review_css_end[];
extern const char telestrain_review_js[], telestrain_review_js_end[];
extern const char telestrain_vtk_js[], telestrain_vtk_js_end[];
extern const char telestrain_vtk_license[], telestrain_vtk_license_end[];
}

namespace telestrain::viz {
namespace {

using Json = nlohmann::ordered_json;

std::string_view Between(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

constexpr const char* kNoWebGl =
    "The interactive scene needs JavaScript and WebGL 2, which are not at hand here. The pictures "
    "below show the same.";
constexpr const char* kNoVtkJs =
    "This page has no interactive scene, because the program that wrote it was built without "
    "vtk.js. To get it: install npm, run 'bash bootstrap build' with the network on, then "
    "'telestrain review' again. The pictures below show the same.";

// A text, or what a sentence with values in it prints.
std::string TextAt(const Json& json, const std::string& key) {
  if (!json.is_object() || !json.contains(key)) return "";
  const Json& text = json.at(key);
  return text.is_string() ? text.get<std::string>() : TextAt(text, "printed");
}

// "report_number" as "Report number".
std::string Spaced(std::string key) {
  std::replace(key.begin(), key.end(), '_', ' ');
  if (!key.empty() && key[0] >= 'a' && key[0] <= 'z') key[0] = static_cast<char>(key[0] - 32);
  return key;
}

// Everything the session says of the document, the number first.
std::string DocumentHtml(const Json& document) {
  std::vector<std::string> keys{"report_number", "revision", "item", "operator", "environment"};
  for (const auto& [key, value] : document.items())
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
  std::string html;
  for (const std::string& key : keys)
    if (const std::string text = TextAt(document, key); !text.empty())
      html += "<dt>" + HtmlText(Spaced(key)) + "</dt><dd>" + HtmlText(text) + "</dd>\n";
  return html;
}

std::string HashesHtml(const ReviewContent& content) {
  std::string html;
  for (const auto& [name, hash] : content.hashes)
    html += "<span>" + HtmlText(name) + " SHA-256 <code title=\"" + HtmlText(hash) + "\">" +
            HtmlText(hash.substr(0, 12)) + "\u2026</code></span>\n";
  return html;
}

// "pipe_strain_003.png" is the pipe's state 3, which the caption names by its image.
std::string CaptionOf(const Scene& scene, const std::string& file_name) {
  static const std::map<std::string, std::string> kCaptions = {
      {"array", "Array: the views, the boards of the target and the pipe"},
      {"side", "Array from the side"},
      {"top", "Array from above"},
      {"rays", "The way of light through the mirrors"},
      {"targets", "Target poses with their residuals and the ruler with its errors"},
      {"pipe", "Pipe with measured displacements and gauges"},
      {"pipe_strain", "Strain on the measured surface of the pipe"},
      {"residuals", "Residuals over the sensor"},
      {"contact_sheet", "All pictures on one sheet"}};
  const std::string stem = file_name.substr(0, file_name.rfind('.'));
  if (const auto known = kCaptions.find(stem); known != kCaptions.end()) return known->second;
  const std::size_t bar = stem.rfind('_');
  const auto kind = kCaptions.find(stem.substr(0, bar));
  const std::optional<int> state =
      bar == std::string::npos ? std::nullopt : ParseInt(stem.substr(bar + 1));
  if (kind == kCaptions.end() || !state || *state < 0) return Spaced(stem);
  const auto index = static_cast<std::size_t>(*state);
  const bool has_name = scene.pipe && index < scene.pipe->states.size();
  return kind->second +
         (has_name ? ", " + scene.pipe->states[index].image : ", state " + std::to_string(index));
}

std::string PicturesHtml(const ReviewContent& content) {
  std::string html;
  for (const ReviewPicture& picture : content.pictures) {
    const std::string caption = HtmlText(CaptionOf(content.scene, picture.name));
    html += "<figure><button type=\"button\" title=\"Enlarge\"><img alt=\"" + caption +
            "\" src=\"data:image/png;base64," + Base64(picture.png) + "\"></button><figcaption>" +
            caption + "</figcaption></figure>\n";
  }
  return html.empty() ? "<p>There are no pictures.</p>" : html;
}

// The bundle as a script element with its licence before it; its last line names a file for
// debuggers, which would be looked for beside the page.
std::string VtkJsElement(const VtkJs& vtk_js, std::string* script) {
  std::string_view bundle = vtk_js.script;
  const std::size_t map = bundle.rfind("//# sourceMappingURL=");
  if (map != std::string_view::npos) bundle = bundle.substr(0, map);
  *script = ScriptText(bundle);
  std::string license(vtk_js.license);
  for (std::size_t at; (at = license.find("--")) != std::string::npos;) license[at] = ' ';
  return "<!-- vtk.js\n" + license + "\n-->\n<script>" + *script + "</script>";
}

void AddScene(const ReviewContent& content, std::map<std::string, std::string>* texts) {
  const std::string script = ScriptText(Between(telestrain_review_js, telestrain_review_js_end));
  const bool interactive = !content.vtk_js.script.empty();
  std::string vtk_script;
  auto& text = *texts;
  text["vtk_js"] = interactive ? VtkJsElement(content.vtk_js, &vtk_script) : "";
  text["js"] = script;
  text["script_hashes"] =
      PolicyHash(script) + (interactive ? " " + PolicyHash(vtk_script) : std::string());
  text["scene_notice"] = interactive ? kNoWebGl : kNoVtkJs;
  text["scene_data"] = interactive
                           ? JsonInScript(SceneJson(content.scene, content.list)
                                              .dump(-1, ' ', false, Json::error_handler_t::replace))
                           : "null";
}

std::string Page(const ReviewContent& content) {
  const Json& results = content.results;
  const Json& document = results.at("document");
  const Json& decision = results.at("decision");
  const VerdictLook look = LookOf(TextAt(results, "verdict"));
  const std::string title = TextAt(results, "title"), number = TextAt(document, "report_number");
  std::map<std::string, std::string> texts{
      {"version", HtmlText(content.version)},
      {"css", std::string(Between(telestrain_review_css, telestrain_review_css_end))},
      {"page_title", HtmlText(title + (number.empty() ? "" : ", " + number) + ": review")},
      {"title", HtmlText(title.empty() ? "Results without a title" : title)},
      {"document", DocumentHtml(document)},
      {"verdict", look.key},
      {"verdict_sign", look.sign},
      {"verdict_word", look.word},
      {"reasons", ReasonsHtml(results)},
      {"decision_rule",
       HtmlText(TextAt(decision, "printed") + " " + TextAt(decision, "printed_undecided"))},
      {"hashes", HashesHtml(content)},
      {"pictures", PicturesHtml(content)},
      {"tables", TablesHtml(results)}};
  AddScene(content, &texts);
  return Filled(Between(telestrain_review_html, telestrain_review_html_end), texts);
}

}  // namespace

VtkJs BuiltInVtkJs() {
  return {Between(telestrain_vtk_js, telestrain_vtk_js_end),
          Between(telestrain_vtk_license, telestrain_vtk_license_end)};
}

Result<std::string> ReviewPage(const ReviewContent& content) {
  TELESTRAIN_RETURN_IF_ERROR(RequireResultsShape(content.results, "results.json"));
  return Page(content);
}

}  // namespace telestrain::viz
