#include "vtkElVisReader.h"

#include "open_volumes.hpp"

#include <nlohmann/json.hpp>

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkStringArray.h>
#include <vtkUnsignedIntArray.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

using elvis_paraview::OpenVolume;

std::vector<double> times_of(const OpenVolume& volume) {
    std::vector<double> times;
    for (std::uint32_t step = 0; step < volume.data.info().n_time_steps; ++step) {
        times.push_back(volume.data.time(step));
    }
    return times;
}

/** The twelve edges of the box. */
void add_box(const double (&bounds)[6], vtkPolyData& output) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (int corner = 0; corner < 8; ++corner) {
        points->InsertNextPoint(bounds[corner & 1 ? 3 : 0], bounds[corner & 2 ? 4 : 1], bounds[corner & 4 ? 5 : 2]);
    }
    vtkNew<vtkCellArray> lines;
    for (vtkIdType corner = 0; corner < 8; ++corner) {
        for (const vtkIdType axis : {1, 2, 4}) {
            if ((corner & axis) == 0) {
                const vtkIdType ends[]{corner, corner | axis};
                lines->InsertNextCell(2, ends);
            }
        }
    }
    output.SetPoints(points);
    output.SetLines(lines);
}

/** The least value at the first corner, the largest at the others. */
void add_range(const std::string& name, const elvis_range& range, vtkPolyData& output) {
    vtkNew<vtkDoubleArray> values;
    values->SetName(name.c_str());
    values->SetNumberOfTuples(8);
    values->Fill(range.maximum);
    values->SetValue(0, range.minimum);
    output.GetPointData()->AddArray(values);
}

void add_ranges(const OpenVolume& volume, std::uint32_t time_step, vtkPolyData& output) {
    for (std::uint32_t index = 0; index < volume.data.info().n_fields; ++index) {
        const elvis_field field = volume.data.field(index);
        std::vector<std::string> names{field.name};
        for (std::uint32_t component = 0; field.n_components > 1 && component < field.n_components; ++component) {
            names.push_back(std::string(field.name) + "[" + std::to_string(component) + "]");
        }
        for (const std::string& name : names) {
            add_range(name, volume.data.range(name, time_step), output);
        }
    }
}

void add_source(const std::vector<std::string>& files, std::uint32_t time_step, vtkPolyData& output) {
    vtkNew<vtkStringArray> names;
    names->SetName("elvis_files");
    for (const std::string& file : files) {
        names->InsertNextValue(file);
    }
    output.GetFieldData()->AddArray(names);
    vtkNew<vtkUnsignedIntArray> step;
    step->SetName("elvis_time_step");
    step->InsertNextValue(time_step);
    output.GetFieldData()->AddArray(step);
}

} // namespace

vtkStandardNewMacro(vtkElVisReader);

vtkElVisReader::vtkElVisReader() { this->SetNumberOfInputPorts(0); }
vtkElVisReader::~vtkElVisReader() = default;

void vtkElVisReader::SetFileName(const char* name) {
    const std::string given = name != nullptr ? name : "";
    if (given != this->FileName) {
        this->FileName = given;
        this->Volume.reset();
        this->Modified();
    }
}

void vtkElVisReader::AddFurtherFile(const char* name) {
    this->FurtherFiles.emplace_back(name != nullptr ? name : "");
    this->Volume.reset();
    this->Modified();
}

void vtkElVisReader::ClearFurtherFiles() {
    if (!this->FurtherFiles.empty()) {
        this->FurtherFiles.clear();
        this->Volume.reset();
        this->Modified();
    }
}

std::vector<std::string> vtkElVisReader::Files() const {
    std::vector<std::string> files{this->FileName};
    for (const std::string& file : this->FurtherFiles) {
        if (!file.empty()) {
            files.push_back(file);
        }
    }
    return files;
}

int vtkElVisReader::CanReadFile(const char* name) {
    try {
        return nlohmann::json::parse(elvis::context().describe_file(name)).at("kind") != "scene" ? 1 : 0;
    } catch (const elvis::error&) {
        return 0;
    }
}

bool vtkElVisReader::Open() {
    try {
        this->Volume = elvis_paraview::open_volume(this->Files());
        return true;
    } catch (const elvis::error& error) {
        vtkErrorMacro(<< error.what());
        return false;
    }
}

int vtkElVisReader::RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) {
    if (!this->Open()) {
        return 0;
    }
    const std::vector<double> times = times_of(*this->Volume);
    vtkInformation* output = outputs->GetInformationObject(0);
    output->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
    if (times.size() > 1) {
        const double ends[]{times.front(), times.back()};
        output->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
        output->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), ends, 2);
    }
    return 1;
}

int vtkElVisReader::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) {
    if (!this->Volume && !this->Open()) {
        return 0;
    }
    vtkInformation* information = outputs->GetInformationObject(0);
    vtkPolyData& output = *vtkPolyData::GetData(information);
    const std::vector<double> times = times_of(*this->Volume);
    std::uint32_t time_step = 0;
    if (information->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP())) {
        // The last step that has been.
        const double time = information->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP());
        const auto next = std::ranges::upper_bound(times, time);
        time_step = static_cast<std::uint32_t>(std::max<std::ptrdiff_t>(next - times.begin() - 1, 0));
        output.GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), times[time_step]);
    }
    add_source(this->Files(), time_step, output);
    if (information->Get(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER()) > 0) {
        return 1;
    }
    try {
        const elvis_data_info info = this->Volume->data.info();
        add_box(info.bounds, output);
        add_ranges(*this->Volume, time_step, output);
    } catch (const elvis::error& error) {
        vtkErrorMacro(<< error.what());
        return 0;
    }
    return 1;
}
