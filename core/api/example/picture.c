/* Draws a volume with libelvis in C: picture VOLUME OUT.png */
#include <elvis/elvis.h>

#include <stdio.h>
#include <string.h>

static int failed(const elvis_context* context, elvis_result result) {
    if (result != ELVIS_OK) {
        fprintf(stderr, "%s\n", elvis_context_error(context));
    }
    return result != ELVIS_OK;
}

static int draw(elvis_context* context, const char* volume, const char* output) {
    elvis_data* data = NULL;
    elvis_scene* scene = NULL;
    elvis_picture* picture = NULL;
    int status = failed(context, elvis_data_open(context, volume, NULL, NULL, NULL, &data)) ||
                 failed(context, elvis_scene_create(context, &scene)) ||
                 failed(context, elvis_scene_set(scene, "/image/size", "[320, 240]")) ||
                 failed(context, elvis_scene_set(scene, "/surfaces/-", "{\"type\": \"boundary\"}")) ||
                 failed(context, elvis_render(data, scene, NULL, NULL, &picture)) ||
                 failed(context, elvis_picture_write_png(picture, output, 8));
    if (status == 0) {
        elvis_picture_info info;
        memset(&info, 0, sizeof info);
        info.struct_size = sizeof info;
        status = failed(context, elvis_picture_get_info(picture, &info));
        printf("%u x %u pixels, %llu of them undecided\n", info.width, info.height,
               (unsigned long long)info.n_undecided_pixels);
    }
    elvis_picture_release(picture);
    elvis_scene_release(scene);
    elvis_data_release(data);
    return status;
}

int main(int argc, char** argv) {
    if (argc != 3) {
        fprintf(stderr, "usage: picture VOLUME OUT.png\n");
        return 2;
    }
    elvis_context* context = NULL;
    int status = failed(NULL, elvis_context_create(NULL, &context));
    if (status == 0) {
        status = draw(context, argv[1], argv[2]);
    }
    elvis_context_release(context);
    return status;
}
