#include "common/chain_record.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "common/data_file.hpp"
#include "common/errors.hpp"

namespace common {

using Json = nlohmann::json;

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ChainStage, name, folder, status, message, exit_status, signal, wall_time,
                                   cpu_time, peak_memory, command)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ChainRecord, status, message, scene, wires, overrides, end, window,
                                   wall_time, stages)

void write_chain_record(const std::filesystem::path& folder, const ChainRecord& record) {
    Json chain = {{"schema", "tsunagi.chain/1"}, {"version", TSUNAGI_VERSION}};
    chain.update(Json(record));
    write_text_file(folder / "chain.json", chain.dump(1) + "\n");
}

ChainRecord read_chain_record(const std::filesystem::path& folder) {
    const std::filesystem::path path = folder / "chain.json";
    std::ifstream stream(path);
    if (!stream)
        throw InputError(fmt::format("{}: no such file (expected the folder of a chain)", path.string()));
    try {
        return Json::parse(stream).get<ChainRecord>();
    } catch (const Json::exception&) {
        throw InputError(fmt::format("{}: damaged, or not written by coupler", path.string()));
    }
}

}  // namespace common
