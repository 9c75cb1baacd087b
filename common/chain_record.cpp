#include "common/chain_record.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "common/data_file.hpp"
#include "common/errors.hpp"

namespace common {

using Json = nlohmann::ordered_json;

void write_chain_record(const std::filesystem::path& folder, const ChainRecord& record) {
    Json stages = Json::array();
    for (const auto& stage : record.stages)
        stages.push_back({{"name", stage.name},
                          {"folder", stage.folder},
                          {"status", stage.status},
                          {"message", stage.message},
                          {"exit_status", stage.exit_status},
                          {"signal", stage.signal},
                          {"wall_time", stage.wall_time},
                          {"cpu_time", stage.cpu_time},
                          {"peak_memory", stage.peak_memory},
                          {"command", stage.command}});
    const Json chain = {
        {"schema", "tsunagi.chain/1"},   {"status", record.status},       {"message", record.message},
        {"version", TSUNAGI_VERSION},    {"scene", record.scene},         {"wires", record.wires},
        {"overrides", record.overrides}, {"wall_time", record.wall_time}, {"stages", stages}};
    write_text_file(folder / "chain.json", chain.dump(1) + "\n");
}

ChainRecord read_chain_record(const std::filesystem::path& folder) {
    const std::filesystem::path path = folder / "chain.json";
    std::ifstream stream(path);
    if (!stream)
        throw InputError(fmt::format("{}: no such file (expected the folder of a chain)", path.string()));
    try {
        const Json chain = Json::parse(stream);
        ChainRecord record{.status = chain.at("status"),
                           .message = chain.at("message"),
                           .scene = chain.at("scene"),
                           .wires = chain.at("wires"),
                           .overrides = chain.at("overrides"),
                           .wall_time = chain.at("wall_time"),
                           .stages = {}};
        for (const auto& stage : chain.at("stages"))
            record.stages.push_back({.name = stage.at("name"),
                                     .folder = stage.at("folder"),
                                     .command = stage.at("command"),
                                     .status = stage.at("status"),
                                     .message = stage.at("message"),
                                     .exit_status = stage.at("exit_status"),
                                     .signal = stage.at("signal"),
                                     .wall_time = stage.at("wall_time"),
                                     .cpu_time = stage.at("cpu_time"),
                                     .peak_memory = stage.at("peak_memory")});
        return record;
    } catch (const Json::exception& error) {
        throw InputError(fmt::format("{}: not a chain record: {}", path.string(), error.what()));
    }
}

}  // namespace common
