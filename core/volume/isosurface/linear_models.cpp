#include <core/shader/kernel_results.hpp>
#include <core/volume/isosurface/linear_models.hpp>

#include <algorithm>
#include <array>
#include <bit>

namespace elvis {

namespace {

/** Elements of one dispatch: bounds time and memory. */
constexpr std::uint64_t model_block = 65536;
constexpr std::uint32_t model_group_size = 32;
/** Words of a record: model and range, and whether that is estimated. */
constexpr std::uint32_t model_record_size = 8;
constexpr std::size_t lower = 5, upper = 6, estimated = 7;

struct ModelParameters {
    std::uint32_t first, n_elements;
    std::uint32_t first_component, end_component;
};

} // namespace

LinearModels::LinearModels(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data)
    : m_device(device), m_volume(volume), m_classes(volume.classes().size()) {
    for (std::uint32_t index = 0; index < m_classes.size(); ++index) {
        const std::uint64_t n_elements = volume.classes()[index].n_elements;
        if (n_elements == 0) {
            continue;
        }
        m_classes[index].models =
            std::make_unique<RecordBuffer>(device, RecordKind::uint, data.precision(), n_elements, model_record_size);
        KernelRequest request;
        request.name = "linear models of element class " + std::to_string(index);
        request.kernel = "field/linear_models.comp";
        request.watches_loops = true;
        request.precision = data.precision();
        data.add_field(request, index, true);
        request.bindings = {{0, BindingType::storage_buffer}};
        request.push_constant_bytes = sizeof(ModelParameters);
        m_classes[index].kernel = std::make_unique<ComposedKernel>(device, request);
    }
}

void LinearModels::provide(const ScalarComponent& component, std::vector<std::vector<ModelRange>>* ranges) {
    if (component == m_component) {
        return;
    }
    // Until all are made: that may be cancelled.
    m_component = {0, 0};
    m_is_all_estimated = true;
    std::vector<std::vector<std::uint32_t>> models(m_classes.size());
    std::vector<std::unique_ptr<const Buffer>> outputs(m_classes.size());
    const auto dispatch = [&](std::size_t index, std::uint64_t first, KernelResults& results) {
        const auto count = static_cast<std::uint32_t>(std::min(model_block, m_volume.classes()[index].n_elements - first));
        const std::array<const Buffer*, 1> bindings = {outputs[index].get()};
        const ModelParameters parameters{static_cast<std::uint32_t>(first), count, component.first, component.end};
        results.dispatch(*m_classes[index].kernel, bindings, std::as_bytes(std::span(&parameters, 1)),
                         (count + model_group_size - 1) / model_group_size, *outputs[index],
                         std::size_t{count} * model_record_size);
    };
    // The first elements of all classes together.
    KernelResults firsts;
    std::vector<std::size_t> with_elements;
    for (std::size_t index = 0; index < m_classes.size(); ++index) {
        if (const std::uint64_t n_elements = m_volume.classes()[index].n_elements; n_elements > 0) {
            outputs[index] =
                std::make_unique<const Buffer>(m_device, std::min(model_block, n_elements) * model_record_size * sizeof(float));
            dispatch(index, 0, firsts);
            with_elements.push_back(index);
        }
    }
    firsts.read();
    for (std::size_t i = 0; i < with_elements.size(); ++i) {
        const std::size_t index = with_elements[i];
        models[index] = firsts[i];
        for (std::uint64_t first = model_block; first < m_volume.classes()[index].n_elements; first += model_block) {
            KernelResults results;
            dispatch(index, first, results);
            results.read();
            models[index].insert(models[index].end(), results[0].begin(), results[0].end());
        }
        for (std::size_t at = estimated; at < models[index].size(); at += model_record_size) {
            m_is_all_estimated = m_is_all_estimated && models[index][at] != 0;
        }
    }
    if (ranges != nullptr) {
        ranges->assign(m_classes.size(), {});
    }
    for (std::size_t index = 0; index < m_classes.size(); ++index) {
        for (std::size_t at = 0; at < models[index].size(); at += model_record_size) {
            std::uint32_t* record = &models[index][at];
            if (ranges != nullptr) {
                (*ranges)[index].push_back(
                    {std::bit_cast<float>(record[lower]), std::bit_cast<float>(record[upper]), record[estimated] != 0});
            }
            record[estimated] = m_is_all_estimated ? 0 : record[estimated];
        }
        if (!models[index].empty()) {
            m_classes[index].models->write_uints(0, models[index]);
        }
    }
    m_component = component;
}

FetchBuffer LinearModels::host_buffer(std::uint32_t element_class) const {
    return {"core_models", m_classes[element_class].models.get()};
}

} // namespace elvis
