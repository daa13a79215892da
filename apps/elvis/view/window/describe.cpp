#include "describe.hpp"

#include <core/base/memory.hpp>

#include <nlohmann/json.hpp>

namespace elvis::view {

namespace {

const char* stage_name(FrameStage stage) {
    switch (stage) {
    case FrameStage::moving:
        return "moving";
    case FrameStage::full:
        return "full";
    case FrameStage::exact:
        return "exact";
    case FrameStage::none:
        break;
    }
    return "none";
}

nlohmann::ordered_json line_json(Workbench& bench) {
    const LineAnswer* const answer = bench.line_answer();
    if (!bench.line || answer == nullptr) {
        return nullptr;
    }
    nlohmann::ordered_json json = {{"from", answer->line.from}, {"to", answer->line.to}, {"error", answer->error}};
    json["breaks"] = answer->breaks;
    json["table"] = table_text(*answer);
    return json;
}

nlohmann::ordered_json second_json(const Workbench& bench) {
    const SecondView& second = bench.second();
    if (!second.is_on()) {
        return nullptr;
    }
    return {{"linked", second.is_linked()},
            {"stage", stage_name(bench.shown(1).stage)},
            {"width", bench.shown(1).picture.width},
            {"scene", second.scene()}};
}

nlohmann::ordered_json numbers_json(const Workbench& bench) {
    return {{"finding", bench.is_finding_numbers()},
            {"present", bench.has_present_numbers()},
            {"table", bench.numbers().empty() ? std::string() : table_text(bench.numbers())}};
}

} // namespace

std::string description(Ui& ui) {
    Workbench& bench = ui.bench;
    const Model& model = bench.model();
    nlohmann::ordered_json json;
    json["settled"] = bench.is_settled();
    json["stage"] = stage_name(bench.stage());
    json["divisor"] = bench.divisor();
    json["activity"] = bench.activity();
    json["milliseconds"] = bench.picture().milliseconds;
    json["frames_per_second"] = bench.motion().frames_per_second();
    json["rest_to_full_seconds"] = bench.motion().rest_to_full_seconds.value_or(-1);
    json["rest_to_exact_seconds"] = bench.motion().rest_to_exact_seconds.value_or(-1);
    json["cancel_milliseconds"] = bench.cancel_times();
    json["volume"] = model.volume() ? model.volume()->path : std::string();
    json["scene"] = model.scene();
    json["undo"] = model.undo_name().value_or("");
    json["redo"] = model.redo_name().value_or("");
    json["items"] = nlohmann::ordered_json::array();
    for (const ItemId& item : items_of(model.scene())) {
        json["items"].push_back(item_label(model.scene(), item));
    }
    json["picked"] = bench.picked() ? bench.picked()->text : std::string();
    json["line"] = line_json(bench);
    json["second"] = second_json(bench);
    json["numbers"] = numbers_json(bench);
    json["messages"] = nlohmann::ordered_json::array();
    for (const Message& message : bench.messages()) {
        json["messages"].push_back(message.text);
    }
    // At rest: else it would change all the time.
    if (bench.is_settled()) {
        const DeviceUse use = bench.device_use();
        json["memory"] = {{"resident", resident_bytes()},
                          {"heap", heap_bytes()},
                          {"device", use.bytes},
                          {"buffers", use.n_buffers},
                          {"kernels", use.n_kernels}};
    }
    json["foreign_file"] = bench.foreign_file.value_or("");
    json["dialog"] = static_cast<int>(ui.dialog);
    json["places"] = ui.places;
    return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
}

} // namespace elvis::view
