#include "report/dcc/dcc.h"

#include "report/dcc/dcc_parts.h"

namespace telestrain {

Result<std::string> MakeDcc(const Json& results, const Json& calibration) {
  DccXml xml;
  {
    const auto root =
        xml.Open("dcc:digitalCalibrationCertificate",
                 {{"xmlns:dcc", "https://ptb.de/dcc"},
                  {"xmlns:si", "https://ptb.de/si"},
                  {"xmlns:xsi", "http://www.w3.org/2001/XMLSchema-instance"},
                  {"xsi:schemaLocation", "https://ptb.de/dcc https://ptb.de/dcc/v3.3.0/dcc.xsd"},
                  {"schemaVersion", "3.3.0"}});
    WriteAdministration(xml, results);
    WriteMeasurementResults(xml, results, calibration);
  }
  return xml.Finish();
}

}  // namespace telestrain
