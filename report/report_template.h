#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "base/result.h"
#include "report/json_lookup.h"
#include "report/page_flow.h"
#include "report/rgb_image.h"
#include "report/text_catalogue.h"

namespace telestrain {

// Which layout, in which language, from where.
struct TemplateChoice {
  std::filesystem::path folder;  // the user's own; empty: built-in templates only
  std::string name = "acceptance";
  std::string language = "en";
};

// The layout of a report (schema "telestrain.template/1") with its look and the texts of its
// language. templates/README.md explains every key, templates/template.schema.json is what is
// checked. A text of the page passes through `Say` or `Fill` on its way.
class ReportTemplate {
 public:
  // Checks everything a layout can get wrong before anything is drawn. Fails with kUsage (no such
  // layout or language) or kBadInput: the file, the JSON pointer of the entry, what was found, and
  // the nearest known word; a logo that is no picture, by its path.
  static Result<ReportTemplate> Load(const TemplateChoice& choice);
  // A layout in English that stands in no file; `name` is what errors call it.
  static Result<ReportTemplate> Parse(const std::string& name, const std::string& text);

  const Json& blocks() const { return json_["blocks"]; }
  const Json& json() const { return json_; }
  const TextCatalogue& texts() const { return texts_; }
  const Look& look() const { return look_; }
  const std::optional<RgbImage>& logo() const { return logo_; }
  double LogoHeight_mm() const { return NumberAt(json_, "/look/logo_height_mm").value_or(12); }

  // A text, a cell or a Phrase of results.json in the report's language and the user's wording.
  std::string Say(const Json& text_or_phrase) const { return texts_.SayPhrase(text_or_phrase); }
  // A text of the layout in that language, with its {{…}} filled.
  std::string Fill(const std::string& text, const Json& values) const;

  // results.json with the tables in that language: titles, columns, units, cells. kBadInput when a
  // table has columns or rows that cannot be drawn.
  Result<Json> SayTables(Json results) const;
  // What the {{…}} of texts can name: results.json without its tables, sentences in that language,
  // and beside it report.title, report.number ("without number" where there is none),
  // report.revision and section.ID, the numbers of the headings that are drawn.
  Json FillValues(const Json& results) const;

  // Called for every wording that has no translation, as often as it is said.
  void OnUntranslated(std::function<void(const std::string&)> call) {
    texts_.on_untranslated = std::move(call);
  }

 private:
  Status ReadLook(const std::filesystem::path& folder);

  Json json_;
  TextCatalogue texts_;
  Look look_;
  std::optional<RgbImage> logo_;
};

// Whether a block's "when" and "unless" are met by what was measured.
bool IsWanted(const Json& results, const Json& block);

}  // namespace telestrain
