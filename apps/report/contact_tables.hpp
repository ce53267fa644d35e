#pragma once

#include "domain/response/model.hpp"
#include "domain/response/response.hpp"

#include <nlohmann/json.hpp>

#include <map>
#include <string>

namespace app {

/// Values and tables of the page of a contact curve, besides the curve.
struct ContactTables {
    nlohmann::json values;                     ///< keys of CURVE.json
    std::map<std::string, std::string> tables; ///< CURVE-NAME.csv by NAME
};

/// Values at the last load, and pressure and gap along a profile or on a map. Up to four load steps are
/// solved again for them. The model is complete. Throws as solve_contact.
ContactTables contact_tables(const rough::Profile& surface, const rough::Model& model,
                             const rough::Response& response);

/// The names of its tables.
std::vector<std::string> contact_table_names(bool is_2d);

} // namespace app
