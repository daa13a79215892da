#include "vtkElVisRepresentation.h"

#include "open_volumes.hpp"
#include "picture_prop.hpp"

#include <vtkAlgorithmOutput.h>
#include <vtkDataSet.h>
#include <vtkDiscretizableColorTransferFunction.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPVRenderView.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkScalarsToColors.h>
#include <vtkStringArray.h>

using elvis_paraview::PictureProp;
using elvis_paraview::ShownItems;

struct vtkElVisRepresentation::State {
    std::shared_ptr<elvis_paraview::OpenVolume> volume;
    ShownItems items;
    vtkSmartPointer<vtkScalarsToColors> colors;
    bool has_light = false;
    vtkNew<PictureProp> prop;
    /** Handed to the view, which delivers something of each representation. */
    vtkNew<vtkPolyData> nothing;
};

vtkStandardNewMacro(vtkElVisRepresentation);

vtkElVisRepresentation::vtkElVisRepresentation() : Internals(new State) {}
vtkElVisRepresentation::~vtkElVisRepresentation() = default;

int vtkElVisRepresentation::FillInputPortInformation(int, vtkInformation* info) {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
    return 1;
}

int vtkElVisRepresentation::RequestData(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) {
    State& state = *this->Internals;
    state.volume.reset();
    if (inputs[0]->GetNumberOfInformationObjects() == 1) {
        const vtkDataObject* input = vtkDataObject::GetData(inputs[0], 0);
        vtkFieldData* given = const_cast<vtkDataObject*>(input)->GetFieldData();
        auto* files = vtkStringArray::SafeDownCast(given->GetAbstractArray("elvis_files"));
        vtkDataArray* step = given->GetArray("elvis_time_step");
        if (files == nullptr || step == nullptr) {
            vtkErrorMacro(
                "The representation ElVis draws what the reader of ElVis gives, not data of other sources and filters.");
        } else {
            state.items.files.clear();
            for (vtkIdType index = 0; index < files->GetNumberOfValues(); ++index) {
                state.items.files.push_back(files->GetValue(index));
            }
            state.items.time_step = static_cast<unsigned>(step->GetTuple1(0));
            try {
                state.volume = elvis_paraview::open_volume(state.items.files);
            } catch (const elvis::error& error) {
                vtkErrorMacro(<< error.what());
            }
        }
    }
    state.prop->show(state.volume, state.items);
    return this->Superclass::RequestData(request, inputs, outputs);
}

int vtkElVisRepresentation::ProcessViewRequest(vtkInformationRequestKey* request, vtkInformation* input,
                                               vtkInformation* output) {
    if (this->Superclass::ProcessViewRequest(request, input, output) == 0) {
        return 0;
    }
    State& state = *this->Internals;
    if (request == vtkPVView::REQUEST_UPDATE()) {
        vtkPVRenderView::SetPiece(input, this, state.nothing);
        // Those of the whole, on every rank: a rank whose part is out of sight would not be asked for its picture.
        if (const double* bounds = state.prop->GetBounds()) {
            vtkPVRenderView::SetGeometryBounds(input, this, const_cast<double*>(bounds));
        }
        vtkPVRenderView::SetRequiresDistributedRendering(input, this, true);
    } else if (request == vtkPVView::REQUEST_UPDATE_LOD()) {
        vtkPVRenderView::SetRequiresDistributedRenderingLOD(input, this, true);
    } else if (request == vtkPVView::REQUEST_RENDER()) {
        const bool has_field = state.colors != nullptr && !state.items.field.empty();
        state.items.colors = has_field ? state.colors.Get() : nullptr;
        auto* map = vtkDiscretizableColorTransferFunction::SafeDownCast(state.items.colors);
        state.items.opacity = state.has_light && map != nullptr ? map->GetScalarOpacityFunction() : nullptr;
        state.prop->show(state.volume, state.items);
    }
    return 1;
}

bool vtkElVisRepresentation::AddToView(vtkView* view) {
    auto* shown = vtkPVRenderView::SafeDownCast(view);
    if (shown == nullptr) {
        return false;
    }
    shown->GetRenderer()->AddViewProp(this->Internals->prop);
    return this->Superclass::AddToView(view);
}

bool vtkElVisRepresentation::RemoveFromView(vtkView* view) {
    auto* shown = vtkPVRenderView::SafeDownCast(view);
    if (shown == nullptr) {
        return false;
    }
    shown->GetRenderer()->RemoveViewProp(this->Internals->prop);
    return this->Superclass::RemoveFromView(view);
}

void vtkElVisRepresentation::SetVisibility(bool is_visible) {
    this->Superclass::SetVisibility(is_visible);
    this->Internals->prop->SetVisibility(is_visible ? 1 : 0);
}

void vtkElVisRepresentation::SetInputArrayToProcess(int index, int port, int connection, int association, const char* name) {
    this->Superclass::SetInputArrayToProcess(index, port, connection, association, name);
    this->Internals->items.field = name != nullptr ? name : "";
    this->Change();
}

void vtkElVisRepresentation::SetLookupTable(vtkScalarsToColors* colors) {
    this->Internals->colors = colors;
    this->Change();
}

void vtkElVisRepresentation::SetDiffuseColor(double red, double green, double blue) {
    this->Internals->items.color = {red, green, blue};
    this->Change();
}

void vtkElVisRepresentation::SetBoundary(bool is_shown) {
    this->Internals->items.has_boundary = is_shown;
    this->Change();
}

void vtkElVisRepresentation::SetMeshLines(bool are_shown) {
    this->Internals->items.has_mesh_lines = are_shown;
    this->Change();
}

void vtkElVisRepresentation::SetLighting(bool is_on) {
    this->Internals->items.is_lit = is_on;
    this->Change();
}

void vtkElVisRepresentation::SetVolume(bool is_shown) {
    this->Internals->has_light = is_shown;
    this->Change();
}

void vtkElVisRepresentation::SetOpacityUnitDistance(double length) {
    this->Internals->items.unit_distance = length;
    this->Change();
}

void vtkElVisRepresentation::SetDoublePrecision(bool is_on) {
    this->Internals->items.is_float64 = is_on;
    this->Change();
}

void vtkElVisRepresentation::AddCutPlane(double a, double b, double c, double d) {
    this->Internals->items.cut_planes.push_back({a, b, c, d});
    this->Change();
}

void vtkElVisRepresentation::ClearCutPlanes() {
    this->Internals->items.cut_planes.clear();
    this->Change();
}

void vtkElVisRepresentation::AddClipPlane(double a, double b, double c, double d) {
    this->Internals->items.clip_planes.push_back({a, b, c, d});
    this->Change();
}

void vtkElVisRepresentation::ClearClipPlanes() {
    this->Internals->items.clip_planes.clear();
    this->Change();
}

void vtkElVisRepresentation::AddIsovalue(double value) {
    this->Internals->items.isovalues.push_back(value);
    this->Change();
}

void vtkElVisRepresentation::ClearIsovalues() {
    this->Internals->items.isovalues.clear();
    this->Change();
}

void vtkElVisRepresentation::SetIsosurfaceField(const char* field) {
    this->Internals->items.isosurface_field = field != nullptr ? field : "";
    this->Change();
}

void vtkElVisRepresentation::AddContour(double value) {
    this->Internals->items.contours.push_back(value);
    this->Change();
}

void vtkElVisRepresentation::ClearContours() {
    this->Internals->items.contours.clear();
    this->Change();
}

const char* vtkElVisRepresentation::GetRemarks() { return this->Internals->prop->remarks().c_str(); }

const char* vtkElVisRepresentation::GetScene() { return this->Internals->prop->scene().c_str(); }

/** The view draws anew; the volume is not asked again. */
void vtkElVisRepresentation::Change() { this->Internals->prop->Modified(); }
